// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light_faces.h"
#include "scene/caster_hull.h"

namespace pdsm {

/// Whether a volume or curves may reach the light of a view, or what lies up to `emitter_depth` before its
/// centre: bounds of the hull's cells are asked. Never of a distant light, whose space begins in front of
/// everything.
[[nodiscard]] bool may_hold_light(const CasterHull& hull, const LightFace& face, double emitter_depth);

}  // namespace pdsm
