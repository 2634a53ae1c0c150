// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "pdsm/bake/scene.h"
#include "scene/caster_hull.h"

namespace pdsm {
namespace {

/// What lies before the first geometry, as a share of the bounds' diagonal: depths have to be greater than 0.
constexpr double kRoomInFront = 1.0 / 16;
/// What is farther out has no place in float, and is dropped by a bake.
constexpr double kFarthest = std::numeric_limits<float>::max();

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  void include(const Geometry& geometry, const glm::dmat3& axes) {
    for (const glm::vec3& local : geometry.mesh->positions) {
      const glm::dvec3 p = glm::dvec3(geometry.local_to_world * glm::dvec4(glm::dvec3(local), 1.0)) * axes;
      if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest)) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
};

/// Bounds of what casts or receives along the axes that are the columns of `axes`.
Bounds bounds_along(const Scene& scene, const glm::dmat3& axes) {
  Bounds bounds;
  for (const Geometry& geometry : scene.geometry)
    if (geometry.mesh && (geometry.casts || geometry.receives)) bounds.include(geometry, axes);
  for (const CasterHull& hull : caster_hulls(scene)) bounds.include(hull.surface, axes);
  return bounds;
}

}  // namespace

void place_distant_light(const Scene& scene, Light& light) {
  if (!is_distant(light)) return;
  const auto r = light_frame(light).rotation;
  const glm::dmat3 axes(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]);
  Bounds bounds = bounds_along(scene, axes);
  if (bounds.empty()) bounds = {glm::dvec3(0), glm::dvec3(0)};
  const double diagonal = glm::length(bounds.high - bounds.low);
  const double room = diagonal > 0 ? kRoomInFront * diagonal : 1;
  const glm::dvec3 middle = 0.5 * bounds.low + 0.5 * bounds.high;
  light.position = axes * glm::dvec3(middle.x, middle.y, bounds.low.z - room);
}

}  // namespace pdsm
