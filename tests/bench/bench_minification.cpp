// SPDX-License-Identifier: Apache-2.0
// What a distant camera sees of a shadow: pixels of K texels each, on the plane at the map's far depth, while
// the pixel grid moves by fractions of a pixel. Against the mean over each pixel's area:
//   error    rms of look-up - area mean
//   shimmer  rms change of a pixel's error from one grid to the next, a 4th of a pixel away: what flickers
// without mip levels (footprint 0) and with them.
// usage: bench_minification MAP (baked with --mip-levels)
#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

namespace {

using namespace pdsm;

/// The plane at far, by position in texels.
class FarPlane {
 public:
  explicit FarPlane(const PenumbraMap& map) : view_(map.views.front()), look_up_(map) {
    const double reach = view_.projection == Projection::perspective ? view_.far_depth : 1;
    metres_ = (view_.window[2] - view_.window[0]) / view_.width * reach;
  }

  /// `footprint` in texels.
  [[nodiscard]] double attenuation(double u, double v, double footprint) const {
    const double reach = view_.projection == Projection::perspective ? view_.far_depth : 1;
    const double x = (view_.window[0] + u / view_.width * (view_.window[2] - view_.window[0])) * reach;
    const double y = (view_.window[1] + v / view_.height * (view_.window[3] - view_.window[1])) * reach;
    const auto& r = view_.world_to_view.rotation;
    const auto& t = view_.world_to_view.translation;
    const double q[3] = {x - t[0], y - t[1], view_.far_depth - t[2]};
    std::array<double, 3> p{};
    for (std::size_t a = 0; a < 3; ++a) p[a] = r[a] * q[0] + r[3 + a] * q[1] + r[6 + a] * q[2];
    return static_cast<double>(look_up_.at(p, Filter::bilinear, footprint * metres_).attenuation);
  }
  [[nodiscard]] double width() const { return view_.width; }
  [[nodiscard]] double height() const { return view_.height; }

 private:
  const View& view_;
  PenumbraLookUp look_up_;
  double metres_;
};

/// Mean over a square of `edge` texels, at two points a texel along each axis.
double area_mean(const FarPlane& plane, double u, double v, int edge) {
  double sum = 0;
  for (int j = 0; j < 2 * edge; ++j)
    for (int i = 0; i < 2 * edge; ++i)
      sum += plane.attenuation(u + 0.5 * (i + 0.5) - 0.5 * edge, v + 0.5 * (j + 0.5) - 0.5 * edge, 0);
  return sum / (4.0 * edge * edge);
}

struct Quality {
  double error = 0, shimmer = 0;
};

Quality measure(const FarPlane& plane, int edge, bool mips) {
  constexpr int kGrids = 5;
  double squares = 0, changes = 0;
  std::size_t count = 0, steps = 0;
  for (double v = edge; v + 2 * edge < plane.height(); v += edge) {
    for (double u = edge; u + 2 * edge < plane.width(); u += edge) {
      double before = 0;
      for (int grid = 0; grid < kGrids; ++grid) {
        const double shift = 0.25 * edge * grid, x = u + shift, y = v + 0.5 * shift;
        const double error = plane.attenuation(x, y, mips ? edge : 0) - area_mean(plane, x, y, edge);
        squares += error * error;
        ++count;
        if (grid > 0) {
          changes += (error - before) * (error - before);
          ++steps;
        }
        before = error;
      }
    }
  }
  return {std::sqrt(squares / static_cast<double>(count)), std::sqrt(changes / static_cast<double>(steps))};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: bench_minification MAP\n");
    return 2;
  }
  try {
    const PenumbraMap map = read_map(argv[1]);
    const FarPlane plane(map);
    fmt::print("texels_per_pixel,error,error_with_mips,shimmer,shimmer_with_mips\n");
    for (const int edge : {1, 2, 4, 8, 16, 32}) {
      const Quality plain = measure(plane, edge, false), mips = measure(plane, edge, true);
      fmt::print("{},{:.5f},{:.5f},{:.5f},{:.5f}\n", edge, plain.error, mips.error, plain.shimmer,
                 mips.shimmer);
    }
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.failure());
  }
}
