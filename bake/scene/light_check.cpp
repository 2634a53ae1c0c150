// SPDX-License-Identifier: Apache-2.0
#include "scene/light_check.h"

#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// Solid angle of a triangle seen from the origin, signed by its winding: negative when its back is seen.
/// Paper: Van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  const double base = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2 * std::atan2(volume, base);
}

/// Whether a closed mesh winds about the world point p.
bool contains(const Geometry& geometry, const glm::dvec3& p) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<glm::dvec3> positions;
  positions.reserve(geometry.mesh->positions.size());
  glm::dvec3 low(kInfinity), high(-kInfinity);
  for (const glm::vec3& local : geometry.mesh->positions) {
    positions.emplace_back(glm::dvec3(geometry.local_to_world * glm::dvec4(glm::dvec3(local), 1.0)) - p);
    low = glm::min(low, positions.back());
    high = glm::max(high, positions.back());
  }
  const glm::dvec3 zero(0);
  if (!glm::all(glm::lessThan(low, zero)) || !glm::all(glm::greaterThan(high, zero))) return false;
  double angle = 0;
  for (const glm::uvec3& t : geometry.mesh->triangles) {
    angle += solid_angle(positions[t.x], positions[t.y], positions[t.z]);
  }
  // A point inside sees 4 pi of the backs, one outside none; a room with inward fronts has its lights
  // outside.
  return angle > 6;
}

}  // namespace

void warn_if_inside(Scene& scene, const Light& light) {
  if (is_distant(light)) return;
  for (const Geometry& geometry : scene.geometry) {
    if (!casts_shadows(geometry) || !geometry.mesh->closed || !contains(geometry, light.position)) continue;
    scene.warnings.push_back(light.name + ": the light lies inside " + geometry.name);
  }
}

}  // namespace pdsm
