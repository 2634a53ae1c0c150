// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "trace/light_space.h"

/// What the rays of maps ask of meshes with masks (docs/maths.md, "Cutouts").
namespace pdsm {

/// A triangle's corners in light space, and where they lie in the mask.
struct MaskedTriangle {
  std::array<glm::vec3, 3> corners;
  std::array<glm::dvec2, 3> places;
};

[[nodiscard]] MaskedTriangle masked_triangle(const LightSpaceMesh& mesh, std::uint32_t triangle);

/// The same for a triangle and its copies, however wound and wherever in the scene: two sides of one leaf
/// have the same holes.
[[nodiscard]] std::uint64_t triangle_key(const MaskedTriangle& triangle);

/// How many texels of the mask a metre in the triangle's plane is, in the direction in which it is most. NaN
/// or infinite for triangles without area.
[[nodiscard]] double mask_texels_per_metre(const MaskedTriangle& triangle, const CutoutMask& mask);

}  // namespace pdsm
