// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Adds a warning for each closed, casting mesh that has the light's centre inside: that light is dark.
void warn_if_inside(Scene& scene, const Light& light);

}  // namespace pdsm
