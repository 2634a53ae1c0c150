// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "pdsm/bake/scene.h"
#include "truth/world_scene.h"

namespace pdsm {

/// The receivers of a scene, where they face the light; those with masks as if they were whole. Any thread,
/// also within a filter function of other rays.
class LitSurfaces {
 public:
  enum class Heading { to_light, from_light };

  struct Hit {
    double distance = 0;  ///< in lengths of the direction
    unsigned geometry = 0, triangle = 0;
    double u = 0, v = 0;  ///< weights of the triangle's second and third corner
  };

  /// Borrows `scene`. Throws Error (resource) when Embree fails.
  explicit LitSurfaces(const Scene& scene);

  /// Where `origin` + s `direction` (world space, metres), s in [from, to], first meets a receiver that is
  /// open or, by its winding, faces the light, which the direction heads to or from.
  [[nodiscard]] std::optional<Hit> meet(Heading heading, const glm::dvec3& origin,
                                        const glm::dvec3& direction, double from, double to) const;

 private:
  struct Context;

  const Scene& scene_;
  WorldScene receivers_;
};

}  // namespace pdsm
