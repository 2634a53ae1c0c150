// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What a light is and where it stands, as maps and manifests tell it. Its frame is made explicit:
/// `direction` and `up` are the frame's z and y. Where a distant light's space begins is in the view.
[[nodiscard]] nlohmann::ordered_json light_json(const Light& light);

}  // namespace pdsm
