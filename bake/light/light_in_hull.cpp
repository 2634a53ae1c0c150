// SPDX-License-Identifier: Apache-2.0
#include "light/light_in_hull.h"

#include <algorithm>
#include <cmath>

#include "light/light_geometry.h"

namespace pdsm {

bool may_hold_light(const CasterHull& hull, const LightFace& face, double emitter_depth) {
  if (is_distant(face.light)) return false;
  const LightSpace space(face.light);
  const glm::dmat4& to_world = hull.surface.local_to_world;
  const double half_edge = 0.5 * hull.edge;
  glm::dvec3 reach(0);
  for (int axis = 0; axis < 3; ++axis)
    reach += half_edge * glm::abs(space.from_world_axes(glm::dvec3(to_world[axis])));
  const auto& half = face.reach;
  return std::ranges::any_of(hull.cells, [&](const glm::ivec3& first) {
    const glm::dvec3 middle = space.from_world_axes(glm::dmat3(to_world) * (glm::dvec3(first) + half_edge) +
                                                    (glm::dvec3(to_world[3]) - face.light.position));
    return std::abs(middle.x) <= reach.x + half[0] && std::abs(middle.y) <= reach.y + half[1] &&
           middle.z + reach.z >= -half[2] && middle.z - reach.z <= std::max(half[2], emitter_depth);
  });
}

}  // namespace pdsm
