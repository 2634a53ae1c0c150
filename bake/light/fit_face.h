// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light_faces.h"
#include "pdsm/bake/view_fit.h"

namespace pdsm {

/// Fits one view of a light, as fit_view() says. The near of a view into whose depth the light reaches is at
/// least twice that reach. Throws as fit_view() does.
[[nodiscard]] FittedView fit_face(const Scene& scene, const LightFace& face);

}  // namespace pdsm
