// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// The border of a light's emitter, world space, metres, closed: the last point is the first. A new light
/// shape has to be drawn here, and nowhere else in the viewer.
[[nodiscard]] std::vector<glm::dvec3> light_outline(const Light& light);

}  // namespace pdsm
