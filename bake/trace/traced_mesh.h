// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trace/light_space.h"
#include "trace/mask_cells.h"

namespace pdsm {

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
