// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light_faces.h"

namespace pdsm {

/// Whether a volume may reach the light of a view, or what lies up to `emitter_depth` before its centre:
/// bounds of occupied cells are asked. Never of a distant light, whose space begins in front of everything.
[[nodiscard]] bool may_hold_light(const Volume& volume, const LightFace& face, double emitter_depth);

}  // namespace pdsm
