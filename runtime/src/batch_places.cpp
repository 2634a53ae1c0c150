// SPDX-License-Identifier: Apache-2.0
#include "batch_places.h"

namespace pdsm {
namespace {

/// `position` between 0 and `last`; 0 for NaNs, so that any may become an integer.
inline double clamp_position(double position, double last) {
  const double above = position > 0 ? position : 0;
  return above < last ? above : last;
}

/// Choices are made between numbers, not between ways to go: compilers turn that into vector instructions.
template <bool kPerspective>
void place_all(const PreparedView& prepared, const std::array<double, 3>* points, std::size_t count,
               double centre, PlaceBatch& places) {
  const View& view = prepared.view;
  const std::array<double, 9> r = view.world_to_view.rotation;
  const std::array<double, 3> t = view.world_to_view.translation;
  const std::array<double, 4> window = view.window;
  const double scale_x = prepared.scale_x, scale_y = prepared.scale_y;
  const double last_x = static_cast<double>(view.width - 1), last_y = static_cast<double>(view.height - 1);
  for (std::size_t n = 0; n < count; ++n) {
    const double* p = points[n].data();
    const double x = r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + t[0];
    const double y = r[3] * p[0] + r[4] * p[1] + r[5] * p[2] + t[1];
    const double z = r[6] * p[0] + r[7] * p[1] + r[8] * p[2] + t[2];
    const double reach = kPerspective ? z : 1;
    double held = z < -kNotHeld ? z : kNotHeld;
    if constexpr (kPerspective) held = z > 0 ? held : kNotHeld;
    held = x >= window[0] * reach ? held : kNotHeld;
    held = x <= window[2] * reach ? held : kNotHeld;
    held = y >= window[1] * reach ? held : kNotHeld;
    held = y <= window[3] * reach ? held : kNotHeld;
    const double u = clamp_position((x / reach - window[0]) * scale_x - centre, last_x);
    const double v = clamp_position((y / reach - window[1]) * scale_y - centre, last_y);
    // Every processor has instructions for signed integers.
    const auto x_low = static_cast<std::int32_t>(u), y_low = static_cast<std::int32_t>(v);
    places.z[n] = held;
    places.x_low[n] = static_cast<std::uint32_t>(x_low);
    places.y_low[n] = static_cast<std::uint32_t>(y_low);
    places.x_share[n] = u - x_low;
    places.y_share[n] = v - y_low;
  }
}

}  // namespace

void place_batch(const PreparedView& prepared, const std::array<double, 3>* points, std::size_t count,
                 Filter filter, PlaceBatch& places) {
  const double centre = filter == Filter::bilinear ? 0.5 : 0;
  if (prepared.view.projection == Projection::perspective)
    place_all<true>(prepared, points, count, centre, places);
  else
    place_all<false>(prepared, points, count, centre, places);
}

}  // namespace pdsm
