// SPDX-License-Identifier: Apache-2.0
#include "light/light_in_volume.h"

#include <algorithm>
#include <cmath>

#include "scene/volume_hull.h"

namespace pdsm {

bool may_hold_light(const Volume& volume, const LightFace& face, double emitter_depth) {
  const Light& light = face.light;
  if (is_distant(light)) return false;
  const auto r = light_frame(light).rotation;
  const glm::dmat3 world_to_light(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]);
  const glm::dmat3 linear = world_to_light * glm::dmat3(volume.index_to_world);
  const glm::dvec3 offset = world_to_light * (glm::dvec3(volume.index_to_world[3]) - light.position);
  constexpr double kHalfEdge = DensityBrick::kEdge / 2.0;
  glm::dvec3 reach(0);
  for (int axis = 0; axis < 3; ++axis) reach += kHalfEdge * glm::abs(linear[axis]);
  const auto& half = face.reach;
  return std::ranges::any_of(occupied_cells(*volume.grid), [&](const glm::ivec3& first) {
    const glm::dvec3 middle = linear * (glm::dvec3(first) + kHalfEdge) + offset;
    return std::abs(middle.x) <= reach.x + half[0] && std::abs(middle.y) <= reach.y + half[1] &&
           middle.z + reach.z >= -half[2] && middle.z - reach.z <= std::max(half[2], emitter_depth);
  });
}

}  // namespace pdsm
