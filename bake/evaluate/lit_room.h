// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "evaluate/camera.h"
#include "evaluate/focus.h"
#include "evaluate/picture_scene.h"
#include "pdsm/bake/scene.h"

/// What a light shines on, for pictures from inside of it. All functions are pure. World positions, metres.
namespace pdsm {

struct LitRoom {
  glm::dvec3 lamp;                 ///< centre of the light
  std::vector<glm::dvec3> points;  ///< just before the casters that it sees, evenly over its directions
};

/// `start` metres off its plane begins what a planar light sees. Nothing of distant lights, and of those half
/// of whose directions lead to no caster.
[[nodiscard]] std::optional<LitRoom> find_lit_room(const PictureScene& picture, const Light& light,
                                                   double start);

/// Around all but the outermost points.
[[nodiscard]] Focus focus_on_room(const LitRoom& room);

/// From before one of the points, at the height of eyes if there is any, the view towards the middle that
/// shows the most of them.
[[nodiscard]] Camera camera_in_room(const PictureScene& picture, const LitRoom& room);

}  // namespace pdsm
