// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "support/scenes.h"

/// Surfaces with holes, made in memory.
namespace pdsm::test {

/// A mask of width x height texels, each 0 or 255: solid where `is_solid(i, j)`.
[[nodiscard]] inline CutoutMask make_mask(std::uint32_t width, std::uint32_t height, float cutoff,
                                          const std::function<bool(std::uint32_t, std::uint32_t)>& is_solid) {
  CutoutMask mask{width, height, {}, {}, cutoff};
  for (std::uint32_t j = 0; j < height; ++j)
    for (std::uint32_t i = 0; i < width; ++i) mask.alpha.push_back(is_solid(i, j) ? 255 : 0);
  return mask;
}

/// The rectangle of the mask's places that a plate shows, from its corner (x0, y0) to (x1, y1).
struct PlaceRect {
  double u0 = 0, v0 = 0, u1 = 1, v1 = 1;
};

[[nodiscard]] inline Mesh cut_plate(const Plate& plate, const CutoutMask& mask, const PlaceRect& r = {}) {
  Mesh mesh = plate_mesh(plate);
  mesh.mask = std::make_shared<const CutoutMask>(mask);
  for (const glm::dvec2 place : {glm::dvec2(r.u0, r.v0), {r.u1, r.v0}, {r.u1, r.v1}, {r.u0, r.v1}})
    mesh.mask_places.emplace_back(place);
  return mesh;
}

/// A round leaf of 32 x 32 texels, its edge between them.
[[nodiscard]] inline CutoutMask leaf_mask() {
  return make_mask(32, 32, 0.5F, [](std::uint32_t i, std::uint32_t j) {
    const double x = i + 0.5 - 16, y = j + 0.5 - 16;
    return x * x + y * y < 14 * 14;
  });
}

/// Leaves of 32 x 32 texels over a floor at depth 8, near ones large and far ones small beside a texel of a
/// map of a hundred texels over tangents of +-0.5; and a whole plate among them.
[[nodiscard]] Scene foliage_scene();

}  // namespace pdsm::test
