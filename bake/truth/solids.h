// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "pdsm/bake/scene.h"
#include "truth/world_scene.h"

namespace pdsm {

/// What the closed receivers of a scene enclose, whole or overlapping. Any thread.
class Solids {
 public:
  /// Throws Error (resource) when Embree fails.
  explicit Solids(const Scene& scene);

  /// Whether `world_point` (metres) lies within a closed receiver, so that no path without crossing a surface
  /// leads there. By signed crossings of three rays, two of which must agree: one may graze an edge. A closed
  /// mesh whose winding shows its inside encloses nothing.
  [[nodiscard]] bool hold(const glm::dvec3& world_point) const;

 private:
  struct Crossings;

  [[nodiscard]] int winding(const glm::dvec3& world_point, const glm::vec3& direction) const;

  WorldScene closed_;
};

}  // namespace pdsm
