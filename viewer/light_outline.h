// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "evaluate/focus.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// Where a light is drawn: its own frame, but a distant light, which is nowhere, gets a place before the
/// focus.
[[nodiscard]] RigidTransform drawn_frame(const Light& light, const Focus& focus);

/// The border of a light's emitter (of a distant light: of its marker), world space, metres, closed: the last
/// point is the first. A new light shape has to be drawn here, and nowhere else in the viewer.
[[nodiscard]] std::vector<glm::dvec3> light_outline(const Light& light, const Focus& focus);

}  // namespace pdsm
