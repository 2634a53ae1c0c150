// SPDX-License-Identifier: Apache-2.0
#include "truth/mesh_emitter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Share of a ray at each end that the emitter's own surface is left out of.
constexpr double kOwnSurface = 1e-4;

using Corners = std::array<glm::dvec3, 3>;

Corners corners_of(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  return {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])};
}

glm::dvec3 winding_normal(const Corners& c) {
  return glm::cross(c[1] - c[0], c[2] - c[0]);
}

std::vector<double> running_areas(const Mesh& mesh) {
  std::vector<double> areas;
  double sum = 0;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    areas.push_back(sum += glm::length(winding_normal(corners_of(mesh, n))) / 2);
  return areas;
}

struct OnTriangle {
  std::size_t triangle;
  glm::dvec3 point;
};

/// `unit[0]` chooses the triangle, and what is left of it a place along one edge.
OnTriangle point_by_area(const Mesh& mesh, const std::vector<double>& areas,
                         const std::array<double, 2>& unit) {
  const double wanted = unit[0] * areas.back();
  const auto found = std::min(std::upper_bound(areas.begin(), areas.end(), wanted), areas.end() - 1);
  const auto triangle = static_cast<std::size_t>(found - areas.begin());
  const double before = triangle == 0 ? 0 : areas[triangle - 1];
  const double rest = std::clamp((wanted - before) / (*found - before), 0.0, 1.0);
  // The unit square folded along its diagonal.
  const bool is_beyond = rest + unit[1] > 1;
  const double a = is_beyond ? 1 - rest : rest, b = is_beyond ? 1 - unit[1] : unit[1];
  const Corners c = corners_of(mesh, triangle);
  return {triangle, c[0] + a * (c[1] - c[0]) + b * (c[2] - c[0])};
}

void throw_fault(void*, RTCError code, const char* message) {
  throw Error(Failure::resource, "embree", std::string(message) + " (" + std::to_string(code) + ")");
}

RTCRay make_ray(const glm::dvec3& from, const glm::dvec3& way, double begin, double end) {
  const glm::vec3 o(from), d(way);
  return {o.x, o.y, o.z, static_cast<float>(begin), d.x, d.y, d.z, 0, static_cast<float>(end), ~0U, 0, 0};
}

}  // namespace

glm::dvec3 mesh_surface_point(const Mesh& mesh, const std::array<double, 2>& unit) {
  return point_by_area(mesh, running_areas(mesh), unit).point;
}

MeshEmitter::MeshEmitter(const Mesh& mesh)
    : mesh_(mesh), area_(running_areas(mesh)), device_(rtcNewDevice(nullptr)) {
  if (!device_) throw_fault(nullptr, rtcGetDeviceError(nullptr), "cannot make a device");
  rtcSetDeviceErrorFunction(device_.get(), throw_fault, nullptr);
  scene_.reset(rtcNewScene(device_.get()));
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             sizeof(glm::vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(glm::uvec3), mesh.triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_.get());
  for (const glm::vec3& p : mesh.positions) size_ = std::max(size_, static_cast<double>(glm::length(p)));
  double volume = 0;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const Corners c = corners_of(mesh, n);
    volume += glm::dot(c[0], winding_normal(c));
  }
  outwards_ = volume < 0 ? -1 : 1;
}

MeshEmitter::Place MeshEmitter::place(const std::array<double, 2>& unit) const {
  const OnTriangle on = point_by_area(mesh_, area_, unit);
  return {on.point, outwards_ * glm::normalize(winding_normal(corners_of(mesh_, on.triangle)))};
}

bool MeshEmitter::hides_itself(const glm::dvec3& from, const glm::dvec3& to_point) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(from, to_point, kOwnSurface, 1 - kOwnSurface);
  rtcOccluded1(scene_.get(), &context, &ray);
  return ray.tfar < 0;
}

MeshEmitter::Seen MeshEmitter::seen(const glm::dvec3& from, const std::array<double, 2>& unit) const {
  const Place on = place(unit);
  const glm::dvec3 way = on.point - from;
  const double distance = glm::length(way);
  if (!(distance > 0)) return {on.point, 0};
  const double facing = -glm::dot(on.normal, way) / distance;
  const double cosine = mesh_.closed ? std::max(0.0, facing) : std::abs(facing);
  if (cosine == 0 || hides_itself(from, way)) return {on.point, 0};
  return {on.point, cosine / (distance * distance)};
}

glm::dvec3 MeshEmitter::model_point(const std::array<double, 2>& unit, const std::array<double, 2>& heading,
                                    double along) const {
  const Place on = place(unit);
  if (!mesh_.closed) return on.point;
  // A point of the sphere that rests on the surface: seen from where it rests, cosine-distributed.
  const double height = 2 * heading[0] - 1, around = 2 * std::numbers::pi * heading[1];
  const double ring = std::sqrt(std::max(0.0, 1 - height * height));
  const glm::dvec3 way = glm::dvec3(ring * std::cos(around), ring * std::sin(around), height) - on.normal;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const double begin = kOwnSurface * size_ / std::max(glm::length(way), kOwnSurface);
  RTCRayHit ray{make_ray(on.point, way, begin, std::numeric_limits<double>::infinity()), {}};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_.get(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return on.point;
  const double sine = std::sin(std::numbers::pi / 2 * along);
  return on.point + sine * sine * static_cast<double>(ray.ray.tfar) * way;
}

}  // namespace pdsm
