// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "trace/light_space.h"
#include "trace/mask_cells.h"

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

/// A mesh as Embree's filters get it. Borrows it.
struct TracedMesh {
  /// `mask_cells` are those of the mesh's mask, which meshes may share, or null where nothing asks.
  TracedMesh(const LightSpaceMesh& mesh, std::shared_ptr<const MaskCells> mask_cells);

  /// What is worked out once of a triangle with holes.
  struct Triangle {
    std::uint64_t key = 0;
    float mask_texels_per_metre = 0;
  };

  const LightSpaceMesh& mesh;
  std::shared_ptr<const MaskCells> cells;
  std::vector<Triangle> triangles;  ///< one a triangle where there are cells, else none
};

/// All of a scene's, in its order.
[[nodiscard]] std::vector<TracedMesh> traced_meshes(const LightSpaceScene& scene);

}  // namespace pdsm
