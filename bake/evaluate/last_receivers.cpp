// SPDX-License-Identifier: Apache-2.0
#include "evaluate/last_receivers.h"

#include "evaluate/texel_quad.h"

namespace pdsm {
namespace {

/// Rays start this share of far behind far, so that a surface at far is met.
constexpr double kBehindFar = 1e-5;

/// What the filter knows.
struct ReceiverContext {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to the whole
  const std::vector<float>* outward;

  /// Rays run towards the light: a surface that faces it is met from behind, with its normal along the ray.
  static void filter(const RTCFilterFunctionNArguments* args) {
    const auto& self = *reinterpret_cast<const ReceiverContext*>(args->context);
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; ++i) {
      if (args->valid[i] != -1) continue;
      const float along = RTCRayN_dir_x(args->ray, n, i) * RTCHitN_Ng_x(args->hit, n, i) +
                          RTCRayN_dir_y(args->ray, n, i) * RTCHitN_Ng_y(args->hit, n, i) +
                          RTCRayN_dir_z(args->ray, n, i) * RTCHitN_Ng_z(args->hit, n, i);
      if (along * (*self.outward)[RTCHitN_geomID(args->hit, n, i)] < 0) args->valid[i] = 0;
    }
  }
};

bool is_receiver(const Geometry& geometry) {
  return geometry.receives;
}

/// The point in doubles: it lies on the surface better than the ray's end.
glm::dvec3 point_of_hit(const Geometry& geometry, const RTCHit& hit) {
  const glm::uvec3& triangle = geometry.mesh->triangles[hit.primID];
  const glm::dvec3 weights(1 - static_cast<double>(hit.u) - static_cast<double>(hit.v), hit.u, hit.v);
  glm::dvec3 point(0);
  for (int c = 0; c < 3; ++c) point += weights[c] * to_world(geometry, geometry.mesh->positions[triangle[c]]);
  return point;
}

}  // namespace

LastReceivers::LastReceivers(const Scene& scene, const View& view)
    : scene_(scene), view_(view), world_(scene, is_receiver) {
  for (const Geometry& geometry : scene.geometry) {
    const bool mirrored = glm::determinant(glm::dmat3(geometry.local_to_world)) < 0;
    outward_.push_back(geometry.mesh->closed ? (mirrored ? -1.0F : 1.0F) : 0.0F);
  }
}

std::optional<glm::dvec3> LastReceivers::find(const std::array<std::uint32_t, 2>& texel) const {
  const glm::dvec3 start = point_on_ray(view_, texel, view_.far_depth * (1 + kBehindFar));
  const glm::vec3 origin(start - world_.centre());
  const glm::vec3 along(point_on_ray(view_, texel, view_.near_depth) - start);
  RTCRayHit query{};
  query.ray.org_x = origin.x;
  query.ray.org_y = origin.y;
  query.ray.org_z = origin.z;
  query.ray.dir_x = along.x;
  query.ray.dir_y = along.y;
  query.ray.dir_z = along.z;
  query.ray.tfar = 1;
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ReceiverContext receiver{{}, &outward_};
  rtcInitIntersectContext(&receiver.context);
  receiver.context.filter = ReceiverContext::filter;
  rtcIntersect1(world_.handle(), &receiver.context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return point_of_hit(scene_.geometry[query.hit.geomID], query.hit);
}

}  // namespace pdsm
