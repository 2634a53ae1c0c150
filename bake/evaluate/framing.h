// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "evaluate/camera.h"
#include "evaluate/focus.h"
#include "evaluate/picture_scene.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// What a picture shows unless it is told.
struct Framing {
  Focus focus;
  Camera camera;
};

/// The casters, in a three-quarter view from the first side that shows about as much of them as any. Where
/// `lights` shine on nothing that can be seen from there, because they hang in closed rooms: the first
/// light's room, from inside. `given`: the camera, if one is given. Pure.
[[nodiscard]] Framing find_framing(const Scene& scene, const PictureScene& picture,
                                   std::span<const Light> lights,
                                   const std::optional<Camera>& given = std::nullopt);

}  // namespace pdsm
