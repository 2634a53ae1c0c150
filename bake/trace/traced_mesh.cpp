// SPDX-License-Identifier: Apache-2.0
#include "trace/traced_mesh.h"

#include <map>
#include <utility>

#include "trace/masked_triangles.h"

namespace pdsm {

TracedMesh::TracedMesh(const LightSpaceMesh& of, std::shared_ptr<const MaskCells> mask_cells)
    : mesh(of), cells(std::move(mask_cells)) {
  if (!cells) return;
  triangles.reserve(mesh.triangles.size());
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    const MaskedTriangle triangle = masked_triangle(mesh, n);
    triangles.push_back(
        {triangle_key(triangle), static_cast<float>(mask_texels_per_metre(triangle, *mesh.mask))});
  }
}

std::vector<TracedMesh> traced_meshes(const LightSpaceScene& scene) {
  std::map<const CutoutMask*, std::shared_ptr<const MaskCells>> known;
  std::vector<TracedMesh> traced;
  traced.reserve(scene.meshes.size());
  for (const LightSpaceMesh& mesh : scene.meshes) {
    std::shared_ptr<const MaskCells> cells;
    if (mesh.casts && mesh.has_holes()) {
      std::shared_ptr<const MaskCells>& of_mask = known[mesh.mask.get()];
      if (!of_mask) of_mask = std::make_shared<MaskCells>(*mesh.mask);
      cells = of_mask;
    }
    traced.emplace_back(mesh, std::move(cells));
  }
  return traced;
}

}  // namespace pdsm
