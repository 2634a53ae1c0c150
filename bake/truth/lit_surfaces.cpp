// SPDX-License-Identifier: Apache-2.0
#include "truth/lit_surfaces.h"

namespace pdsm {
namespace {

bool is_receiver(const Geometry& geometry) {
  return geometry.receives;
}

}  // namespace

struct LitSurfaces::Context {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to the whole
  const Scene* scene;
  float sign;  // of a lit surface's outward normal along the ray

  /// Of single rays.
  static void filter(const RTCFilterFunctionNArguments* args) {
    const auto& self = *reinterpret_cast<const Context*>(args->context);
    const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
    const float along = ray->dir_x * hit->Ng_x + ray->dir_y * hit->Ng_y + ray->dir_z * hit->Ng_z;
    if (self.scene->geometry[hit->geomID].mesh->closed && self.sign * along <= 0) args->valid[0] = 0;
  }
};

LitSurfaces::LitSurfaces(const Scene& scene) : scene_(scene), receivers_(scene, is_receiver, Holes::filled) {}

std::optional<LitSurfaces::Hit> LitSurfaces::meet(Heading heading, const glm::dvec3& origin,
                                                  const glm::dvec3& direction, double from, double to) const {
  Context facing{{}, &scene_, heading == Heading::to_light ? 1.0F : -1.0F};
  rtcInitIntersectContext(&facing.context);
  facing.context.filter = Context::filter;
  const glm::vec3 start(origin - receivers_.centre());
  RTCRayHit ray{};
  ray.ray.org_x = start.x;
  ray.ray.org_y = start.y;
  ray.ray.org_z = start.z;
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.dir_z = static_cast<float>(direction.z);
  ray.ray.tnear = static_cast<float>(from);
  ray.ray.tfar = static_cast<float>(to);
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(receivers_.handle(), &facing.context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{ray.ray.tfar, ray.hit.geomID, ray.hit.primID, ray.hit.u, ray.hit.v};
}

}  // namespace pdsm
