// SPDX-License-Identifier: Apache-2.0
#include "truth/world_scene.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Centre of the bounds of all finite vertices of the kept geometry; the origin when there are none.
glm::dvec3 bounds_centre(const Scene& scene, const std::function<bool(const Geometry&)>& keep) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-std::numeric_limits<double>::infinity());
  for (const Geometry& geometry : scene.geometry) {
    if (!keep(geometry)) continue;
    for (const glm::vec3& position : geometry.mesh->positions) {
      const glm::dvec3 world = to_world(geometry, position);
      if (!std::isfinite(world.x + world.y + world.z)) continue;
      low = glm::min(low, world);
      high = glm::max(high, world);
    }
  }
  return low.x <= high.x ? 0.5 * (low + high) : glm::dvec3(0);
}

void throw_embree_error(void*, RTCError, const char* message) {
  throw Error(Failure::resource, "embree", message);
}

std::vector<glm::uvec3> kept_triangles(const Geometry& geometry, const KeepTriangle& keep_triangle) {
  const Mesh& mesh = *geometry.mesh;
  if (!keep_triangle) return mesh.triangles;
  std::vector<glm::uvec3> kept;
  kept.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    const std::array<glm::dvec3, 3> corners{to_world(geometry, mesh.positions[triangle.x]),
                                            to_world(geometry, mesh.positions[triangle.y]),
                                            to_world(geometry, mesh.positions[triangle.z])};
    if (keep_triangle(corners)) kept.push_back(triangle);
  }
  return kept;
}

}  // namespace

glm::dvec3 to_world(const Geometry& geometry, const glm::vec3& position) {
  return glm::dvec3(geometry.local_to_world * glm::dvec4(glm::dvec3(position), 1.0));
}

WorldScene::WorldScene(const Scene& scene, const std::function<bool(const Geometry&)>& keep,
                       const KeepTriangle& keep_triangle)
    : device_(rtcNewDevice(nullptr)), centre_(bounds_centre(scene, keep)) {
  if (device_ == nullptr) throw Error(Failure::resource, "embree", "no device");
  rtcSetDeviceErrorFunction(device_.get(), throw_embree_error, nullptr);
  scene_.reset(rtcNewScene(device_.get()));
  // Without the robust flag rays slip through the shared edges of a closed mesh.
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  for (std::size_t i = 0; i < scene.geometry.size(); ++i) {
    if (keep(scene.geometry[i])) attach(scene.geometry[i], static_cast<unsigned>(i), keep_triangle);
  }
  rtcCommitScene(scene_.get());
}

void WorldScene::attach(const Geometry& geometry, unsigned id, const KeepTriangle& keep_triangle) {
  const std::vector<glm::vec3>& positions = geometry.mesh->positions;
  const std::vector<glm::uvec3> triangles = kept_triangles(geometry, keep_triangle);
  if (triangles.empty()) return;

  RTCGeometry target = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      target, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    vertices[i] = glm::vec3(to_world(geometry, positions[i]) - centre_);
  }
  auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      target, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.size()));
  std::copy(triangles.begin(), triangles.end(), indices);
  rtcCommitGeometry(target);
  rtcAttachGeometryByID(scene_.get(), target, id);
  rtcReleaseGeometry(target);
}

}  // namespace pdsm
