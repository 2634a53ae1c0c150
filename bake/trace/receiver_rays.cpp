// SPDX-License-Identifier: Apache-2.0
#include "trace/receiver_rays.h"

#include <cmath>

#include "trace/traced_mesh.h"

namespace pdsm {
namespace {

/// Rays start this share of far behind far; traced depths are this near to the truth at the least.
constexpr double kBehindFar = 1e-3;

/// A light-facing surface's outward normal points along a ray to the light, and against one from it.
template <Heading heading>
void keep_light_facing(const RTCFilterFunctionNArguments* args) {
  if (!static_cast<const TracedMesh*>(args->geometryUserPtr)->mesh.closed) return;
  const unsigned n = args->N;
  for (unsigned lane = 0; lane < n; ++lane) {
    if (args->valid[lane] != -1) continue;
    const float along = RTCRayN_dir_x(args->ray, n, lane) * RTCHitN_Ng_x(args->hit, n, lane) +
                        RTCRayN_dir_y(args->ray, n, lane) * RTCHitN_Ng_y(args->hit, n, lane) +
                        RTCRayN_dir_z(args->ray, n, lane) * RTCHitN_Ng_z(args->hit, n, lane);
    if (heading == Heading::to_light ? along <= 0 : along >= 0) args->valid[lane] = 0;
  }
}

}  // namespace

ReceiverContext::ReceiverContext(Heading heading) {
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.filter = heading == Heading::to_light ? keep_light_facing<Heading::to_light>
                                                : keep_light_facing<Heading::from_light>;
}

double receiver_ray_start(const MapGrid& grid) {
  return grid.far_depth * (1 + kBehindFar);
}

RayToLight ray_to_light(const CentralRay& ray, double start) {
  return {glm::vec3(ray.origin + start * ray.direction), glm::vec3(-ray.direction)};
}

PlaneOnRay plane_on_ray(const LightSpaceMesh& mesh, unsigned triangle, const MapGrid& grid,
                        const CentralRay& ray) {
  // n . (o + z d) = c, so z = (c - n . o) / (n . d). A change of slope by 1 moves the point by the spread s
  // at its depth, z (perspective) or 1, so dz/du = -s n_x / (n . d).
  const glm::uvec3 t = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = glm::dot(normal, ray.direction),
               depth = (glm::dot(normal, a) - glm::dot(normal, ray.origin)) / facing;
  const double spread = grid.spread_at(depth);
  return {depth, -spread * normal.x / facing, -spread * normal.y / facing};
}

double surface_depth(const MapGrid& grid, const PlaneOnRay& plane, double traced_depth) {
  const bool agree = std::abs(plane.depth - traced_depth) <= kBehindFar * grid.far_depth;
  return agree ? plane.depth : traced_depth;
}

}  // namespace pdsm
