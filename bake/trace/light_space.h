// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// One geometry of a scene, moved to light space in double and only then rounded to float: a scene far
/// from the world's origin loses nothing.
struct LightSpaceMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  bool casts = true, receives = true, closed = false;
};

/// The scene as one light sees it. Triangles with coordinates that are not finite are left out and counted.
struct LightSpaceScene {
  std::vector<LightSpaceMesh> meshes;
  std::uint64_t triangles = 0, dropped_triangles = 0;
};

[[nodiscard]] LightSpaceScene to_light_space(const Scene& scene, const RigidTransform& world_to_light);

}  // namespace pdsm
