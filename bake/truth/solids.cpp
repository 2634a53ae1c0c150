// SPDX-License-Identifier: Apache-2.0
#include "truth/solids.h"

#include <array>
#include <limits>

namespace pdsm {
namespace {

/// Unlike any axis or diagonal, along which modelled edges lie.
const std::array<glm::vec3, 3> kDirections{glm::vec3(0.36F, 0.83F, 0.42F), glm::vec3(-0.71F, 0.29F, 0.64F),
                                           glm::vec3(0.23F, -0.57F, 0.79F)};

bool is_closed_receiver(const Geometry& geometry) {
  return geometry.receives && geometry.mesh->closed;
}

}  // namespace

/// Counts all surfaces that a single ray meets: out of a solid by 1, into one by -1.
struct Solids::Crossings {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to the whole
  int out_less_in = 0;

  static void filter(const RTCFilterFunctionNArguments* args) {
    auto& self = *reinterpret_cast<Crossings*>(args->context);
    const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
    const float along = ray->dir_x * hit->Ng_x + ray->dir_y * hit->Ng_y + ray->dir_z * hit->Ng_z;
    self.out_less_in += along > 0 ? 1 : -1;
    args->valid[0] = 0;
  }
};

Solids::Solids(const Scene& scene) : closed_(scene, is_closed_receiver, Holes::filled) {}

bool Solids::hold(const glm::dvec3& world_point) const {
  int holding = 0;
  for (const glm::vec3& direction : kDirections) holding += winding(world_point, direction) > 0 ? 1 : 0;
  return holding >= 2;
}

int Solids::winding(const glm::dvec3& world_point, const glm::vec3& direction) const {
  Crossings crossings{{}, 0};
  rtcInitIntersectContext(&crossings.context);
  crossings.context.filter = Crossings::filter;
  const glm::vec3 start(world_point - closed_.centre());
  RTCRay ray{};
  ray.org_x = start.x;
  ray.org_y = start.y;
  ray.org_z = start.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  rtcOccluded1(closed_.handle(), &crossings.context, &ray);
  return crossings.out_less_in;
}

}  // namespace pdsm
