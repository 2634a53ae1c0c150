// SPDX-License-Identifier: Apache-2.0
#include "trace/light_space.h"

#include <algorithm>
#include <cmath>

#include "scene/caster_hull.h"
#include "scene/scene_channels.h"

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

bool is_finite(const glm::vec2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

bool is_good(const LightSpaceMesh& mesh, std::uint32_t corner) {
  return corner < mesh.positions.size() && is_finite(mesh.positions[corner]) &&
         (!mesh.mask || is_finite(mesh.mask_places[corner]));
}

LightSpaceMesh move_mesh(const Geometry& geometry, const glm::dmat4& world_to_light, std::uint64_t& dropped) {
  LightSpaceMesh mesh;
  mesh.casts = casts_shadows(geometry);
  mesh.opacity = geometry.opacity;
  mesh.receives = geometry.receives;
  mesh.closed = geometry.mesh->closed;
  mesh.mask = geometry.mesh->mask;
  mesh.mask_places = geometry.mesh->mask_places;
  const glm::dmat4 local_to_light = world_to_light * geometry.local_to_world;
  // Embree loads 16 bytes a vertex, so one more must be readable behind the last.
  mesh.positions.reserve(geometry.mesh->positions.size() + 1);
  for (const glm::vec3& p : geometry.mesh->positions) {
    mesh.positions.emplace_back(glm::dvec3(local_to_light * glm::dvec4(glm::dvec3(p), 1.0)));
  }
  mesh.triangles.reserve(geometry.mesh->triangles.size());
  for (const glm::uvec3& t : geometry.mesh->triangles) {
    if (is_good(mesh, t.x) && is_good(mesh, t.y) && is_good(mesh, t.z))
      mesh.triangles.push_back(t);
    else
      ++dropped;
  }
  return mesh;
}

LightSpaceHull move_hull(const CasterHull& hull, const glm::dmat4& world_to_light) {
  std::uint64_t dropped = 0;
  return {move_mesh(hull.surface, world_to_light, dropped)};
}

LightSpaceVolume move_volume(const Volume& volume, const glm::dmat4& world_to_light) {
  LightSpaceVolume moved;
  moved.grid = volume.grid;
  moved.light_to_index = glm::inverse(world_to_light * volume.index_to_world);
  moved.extinction = volume.extinction;
  moved.hull = move_hull(volume_hull(volume), world_to_light);
  return moved;
}

LightSpaceCurves move_curves(const Curves& curves, const glm::dmat4& world_to_light) {
  LightSpaceCurves moved;
  const glm::dmat4 local_to_light = world_to_light * curves.local_to_world;
  const double scale = length_scale(curves.local_to_world);
  // Embree loads 16 bytes a point, which it has.
  for (const glm::vec4& p : curves.strands->points) {
    const glm::dvec3 at(local_to_light * glm::dvec4(p.x, p.y, p.z, 1.0));
    moved.points.emplace_back(glm::vec3(at), static_cast<float>(scale * static_cast<double>(p.w)));
  }
  moved.segments = curves.strands->segments;
  moved.shape = curves.shape;
  moved.hull = move_hull(curve_hull(curves), world_to_light);
  return moved;
}

}  // namespace

bool LightSpaceHull::begins_before(double depth) const {
  return std::ranges::any_of(surface.positions,
                             [&](const glm::vec3& p) { return static_cast<double>(p.z) <= depth; });
}

bool LightSpaceScene::has_cutouts() const {
  return std::ranges::any_of(meshes, &LightSpaceMesh::is_cutout_caster);
}

bool LightSpaceScene::has_translucency() const {
  return std::ranges::any_of(
      meshes, [](const LightSpaceMesh& mesh) { return mesh.has_layers && !mesh.triangles.empty(); });
}

bool LightSpaceScene::is_coloured() const {
  return std::ranges::any_of(
      meshes, [](const LightSpaceMesh& mesh) { return mesh.is_coloured && !mesh.triangles.empty(); });
}

LightSpaceScene to_light_space(const Scene& scene, const RigidTransform& world_to_light,
                               std::uint32_t channel) {
  LightSpaceScene result;
  const glm::dmat4 matrix = to_matrix(world_to_light);
  for (const Geometry& geometry : scene.geometry) {
    if (!geometry.casts && !geometry.receives) continue;
    check_opacity(geometry);
    check_mask(*geometry.mesh, geometry.name);
    LightSpaceMesh& mesh = result.meshes.emplace_back(
        move_mesh(channel_geometry(geometry, channel), matrix, result.dropped_triangles));
    mesh.has_layers = is_translucent_caster(geometry);
    mesh.is_coloured = is_coloured_caster(geometry);
    result.triangles += mesh.triangles.size();
  }
  for (const Volume& volume : scene.volumes) {
    check_volume(volume);
    if (casts_shadows(volume)) result.volumes.push_back(move_volume(volume, matrix));
  }
  for (const Curves& curves : scene.curves) {
    check_curves(curves);
    if (casts_shadows(curves)) result.curves.push_back(move_curves(curves, matrix));
  }
  return result;
}

}  // namespace pdsm
