// SPDX-License-Identifier: Apache-2.0
#include "truth/world_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "pdsm/format/error.h"
#include "truth/cutout_surface.h"

namespace pdsm {
namespace {

/// Centre of the bounds of all finite vertices of the kept geometry; the origin when there are none.
glm::dvec3 bounds_centre(const Scene& scene, const std::function<bool(const Geometry&)>& keep,
                         const KeepCurves& keep_curves) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-std::numeric_limits<double>::infinity());
  const auto include = [&](const glm::dvec3& world) {
    if (!std::isfinite(world.x + world.y + world.z)) return;
    low = glm::min(low, world);
    high = glm::max(high, world);
  };
  for (const Geometry& geometry : scene.geometry)
    if (keep(geometry))
      for (const glm::vec3& position : geometry.mesh->positions) include(to_world(geometry, position));
  for (const Curves& curves : scene.curves)
    if (keep_curves && keep_curves(curves) && curves.strands)
      for (const glm::vec4& point : curves.strands->points) include(to_world(curves, glm::vec3(point)));
  return low.x <= high.x ? 0.5 * (low + high) : glm::dvec3(0);
}

void throw_embree_error(void*, RTCError, const char* message) {
  throw Error(Failure::resource, "embree", message);
}

template <typename T>
T* new_buffer(RTCGeometry target, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(target, type, 0, format, sizeof(T), count));
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

glm::dvec3 to_world(const Curves& curves, const glm::vec3& position) {
  return glm::dvec3(curves.local_to_world * glm::dvec4(glm::dvec3(position), 1.0));
}

/// What the filter of a geometry with a mask knows.
struct WorldScene::Cutout {
  RTCGeometry geometry;
  std::shared_ptr<const CutoutMask> mask;

  static void filter(const RTCFilterFunctionNArguments* args) {
    const auto& self = *static_cast<const Cutout*>(args->geometryUserPtr);
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; ++i) {
      if (args->valid[i] != -1) continue;
      glm::vec2 place;
      rtcInterpolate0(self.geometry, RTCHitN_primID(args->hit, n, i), RTCHitN_u(args->hit, n, i),
                      RTCHitN_v(args->hit, n, i), RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, &place.x, 2);
      if (is_hole(*self.mask, glm::dvec2(place))) args->valid[i] = 0;
    }
  }
};

WorldScene::~WorldScene() = default;

WorldScene::WorldScene(const Scene& scene, const std::function<bool(const Geometry&)>& keep, Holes holes,
                       const KeepTriangle& keep_triangle, const KeepCurves& keep_curves)
    : device_(rtcNewDevice(nullptr)), centre_(bounds_centre(scene, keep, keep_curves)) {
  if (device_ == nullptr) throw Error(Failure::resource, "embree", "no device");
  rtcSetDeviceErrorFunction(device_.get(), throw_embree_error, nullptr);
  scene_.reset(rtcNewScene(device_.get()));
  // Without the robust flag rays slip through the shared edges of a closed mesh.
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  for (std::size_t i = 0; i < scene.geometry.size(); ++i) {
    if (keep(scene.geometry[i])) attach(scene.geometry[i], static_cast<unsigned>(i), holes, keep_triangle);
  }
  for (std::size_t i = 0; i < scene.curves.size() && keep_curves; ++i)
    if (keep_curves(scene.curves[i]))
      attach(scene.curves[i], static_cast<unsigned>(scene.geometry.size() + i));
  rtcCommitScene(scene_.get());
}

void WorldScene::attach(const Curves& curves, unsigned id) {
  check_curves(curves);
  const Strands& strands = *curves.strands;
  if (strands.segments.empty()) return;
  const double scale = length_scale(curves.local_to_world);
  RTCGeometry target =
      rtcNewGeometry(device_.get(), curves.shape == CurveShape::round ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                                                      : RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE);
  auto* points =
      new_buffer<glm::vec4>(target, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, strands.points.size());
  for (std::size_t i = 0; i < strands.points.size(); ++i) {
    const glm::vec4& p = strands.points[i];
    points[i] = glm::vec4(glm::vec3(to_world(curves, glm::vec3(p)) - centre_),
                          static_cast<float>(scale * static_cast<double>(p.w)));
  }
  auto* segments =
      new_buffer<std::uint32_t>(target, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, strands.segments.size());
  std::ranges::copy(strands.segments, segments);
  rtcCommitGeometry(target);
  rtcAttachGeometryByID(scene_.get(), target, id);
  rtcReleaseGeometry(target);
}

void WorldScene::attach(const Geometry& geometry, unsigned id, Holes holes,
                        const KeepTriangle& keep_triangle) {
  const Mesh& mesh = *geometry.mesh;
  check_mask(mesh, geometry.name);
  const std::vector<glm::uvec3> triangles = kept_triangles(geometry, keep_triangle);
  if (triangles.empty()) return;

  RTCGeometry target = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      new_buffer<glm::vec3>(target, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    vertices[i] = glm::vec3(to_world(geometry, mesh.positions[i]) - centre_);
  }
  auto* indices = new_buffer<glm::uvec3>(target, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.size());
  std::copy(triangles.begin(), triangles.end(), indices);
  if (mesh.mask && holes == Holes::open) cut_out(target, mesh);
  rtcCommitGeometry(target);
  rtcAttachGeometryByID(scene_.get(), target, id);
  rtcReleaseGeometry(target);
}

void WorldScene::cut_out(RTCGeometry target, const Mesh& mesh) {
  rtcSetGeometryVertexAttributeCount(target, 1);
  auto* places = new_buffer<glm::vec2>(target, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, RTC_FORMAT_FLOAT2,
                                       mesh.mask_places.size());
  std::copy(mesh.mask_places.begin(), mesh.mask_places.end(), places);
  cutouts_.push_back(std::make_unique<const Cutout>(Cutout{target, mesh.mask}));
  if (mesh.mask->blends) return;
  rtcSetGeometryUserData(target, const_cast<Cutout*>(cutouts_.back().get()));
  rtcSetGeometryIntersectFilterFunction(target, Cutout::filter);
  rtcSetGeometryOccludedFilterFunction(target, Cutout::filter);
}

glm::dvec2 WorldScene::mask_place(unsigned geometry, unsigned triangle, float u, float v) const {
  glm::vec2 place;
  rtcInterpolate0(rtcGetGeometry(scene_.get(), geometry), triangle, u, v, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0,
                  &place.x, 2);
  return glm::dvec2(place);
}

}  // namespace pdsm
