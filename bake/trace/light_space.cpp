// SPDX-License-Identifier: Apache-2.0
#include "trace/light_space.h"

#include <cmath>

namespace pdsm {
namespace {

glm::dmat4 to_matrix(const RigidTransform& transform) {
  glm::dmat4 m(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      m[column][row] = transform.rotation[static_cast<std::size_t>(3 * row + column)];
    }
    m[3][row] = transform.translation[static_cast<std::size_t>(row)];
  }
  return m;
}

bool is_finite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

LightSpaceMesh move_mesh(const Geometry& geometry, const glm::dmat4& world_to_light, std::uint64_t& dropped) {
  LightSpaceMesh mesh;
  mesh.casts = geometry.casts;
  mesh.receives = geometry.receives;
  mesh.closed = geometry.mesh->closed;
  const glm::dmat4 local_to_light = world_to_light * geometry.local_to_world;
  // Embree loads 16 bytes a vertex, so one more must be readable behind the last.
  mesh.positions.reserve(geometry.mesh->positions.size() + 1);
  for (const glm::vec3& p : geometry.mesh->positions) {
    mesh.positions.emplace_back(glm::dvec3(local_to_light * glm::dvec4(glm::dvec3(p), 1.0)));
  }
  mesh.triangles.reserve(geometry.mesh->triangles.size());
  for (const glm::uvec3& t : geometry.mesh->triangles) {
    const auto count = mesh.positions.size();
    const bool good = t.x < count && t.y < count && t.z < count && is_finite(mesh.positions[t.x]) &&
                      is_finite(mesh.positions[t.y]) && is_finite(mesh.positions[t.z]);
    if (good)
      mesh.triangles.push_back(t);
    else
      ++dropped;
  }
  return mesh;
}

}  // namespace

LightSpaceScene to_light_space(const Scene& scene, const RigidTransform& world_to_light) {
  LightSpaceScene result;
  const glm::dmat4 matrix = to_matrix(world_to_light);
  for (const Geometry& geometry : scene.geometry) {
    if (!geometry.casts && !geometry.receives) continue;
    result.meshes.push_back(move_mesh(geometry, matrix, result.dropped_triangles));
    result.triangles += result.meshes.back().triangles.size();
  }
  return result;
}

}  // namespace pdsm
