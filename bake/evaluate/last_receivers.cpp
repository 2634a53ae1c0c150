// SPDX-License-Identifier: Apache-2.0
#include "evaluate/last_receivers.h"

#include "evaluate/texel_quad.h"

namespace pdsm {
namespace {

/// Rays start this share of far behind far, so that a surface at far is met.
constexpr double kBehindFar = 1e-5;

/// The point in doubles: it lies on the surface better than the ray's end.
glm::dvec3 point_of_hit(const Geometry& geometry, const LitSurfaces::Hit& hit) {
  const glm::uvec3& triangle = geometry.mesh->triangles[hit.triangle];
  const glm::dvec3 weights(1 - hit.u - hit.v, hit.u, hit.v);
  glm::dvec3 point(0);
  for (int c = 0; c < 3; ++c) point += weights[c] * to_world(geometry, geometry.mesh->positions[triangle[c]]);
  return point;
}

}  // namespace

LastReceivers::LastReceivers(const Scene& scene, const View& view)
    : scene_(scene), view_(view), surfaces_(scene) {}

std::optional<glm::dvec3> LastReceivers::find(const std::array<std::uint32_t, 2>& texel) const {
  const glm::dvec3 start = point_on_ray(view_, texel, view_.far_depth * (1 + kBehindFar));
  const glm::dvec3 along = point_on_ray(view_, texel, view_.near_depth) - start;
  const auto hit = surfaces_.meet(LitSurfaces::Heading::to_light, start, along, 0, 1);
  if (!hit) return std::nullopt;
  return point_of_hit(scene_.geometry[hit->geometry], *hit);
}

}  // namespace pdsm
