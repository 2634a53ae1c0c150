// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuzz_target.h"
#include "scene/geometry_import.h"

namespace pdsm::testing {

/// What all importers promise of the parts that they let through.
inline void demand_sound(const ImportedFile& file) {
  for (const Geometry& part : file.parts) {
    demand(!part.mesh->triangles.empty(), "no parts without triangles");
    const std::size_t count = part.mesh->positions.size();
    for (const glm::uvec3& t : part.mesh->triangles)
      demand(t.x < count && t.y < count && t.z < count, "corners that the mesh has");
    check_mask(*part.mesh, part.name);
  }
}

}  // namespace pdsm::testing
