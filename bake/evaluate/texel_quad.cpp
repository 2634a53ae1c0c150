// SPDX-License-Identifier: Apache-2.0
#include "evaluate/texel_quad.h"

#include <algorithm>

#include "pdsm/bake/scene.h"

namespace pdsm {
namespace {

/// What a point's x and y are divided by to compare with the window.
double spread_at(const View& view, double depth) {
  return view.projection == Projection::perspective ? depth : 1.0;
}

}  // namespace

TexelQuad quad_at(const View& view, const glm::dvec3& world_point) {
  const glm::dvec3 p = apply(view.world_to_view, world_point);
  const std::array<std::uint32_t, 2> size{view.width, view.height};
  TexelQuad quad;
  quad.depth = p.z;
  std::array<std::array<std::uint32_t, 2>, 2> ends{};  // of each axis: low, high
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double low = view.window[axis], high = view.window[axis + 2];
    const double slope = p[static_cast<int>(axis)] / spread_at(view, p.z);
    const double centred = (slope - low) / (high - low) * size[axis] - 0.5;
    const double inside = std::clamp(centred, 0.0, static_cast<double>(size[axis] - 1));
    ends[axis][0] = static_cast<std::uint32_t>(inside);
    ends[axis][1] = std::min(ends[axis][0] + 1, size[axis] - 1);
    quad.share[axis] = inside - ends[axis][0];
  }
  for (std::size_t corner = 0; corner < 4; ++corner)
    quad.texel[corner] = {ends[0][corner % 2], ends[1][corner / 2]};
  return quad;
}

glm::dvec3 point_on_ray(const View& view, const std::array<std::uint32_t, 2>& texel, double depth) {
  const double spread = spread_at(view, depth);
  const auto centre = [&](std::size_t axis, std::uint32_t size) {
    const double low = view.window[axis], high = view.window[axis + 2];
    return (low + (texel[axis] + 0.5) / size * (high - low)) * spread;
  };
  return apply(inverse(view.world_to_view), glm::dvec3(centre(0, view.width), centre(1, view.height), depth));
}

}  // namespace pdsm
