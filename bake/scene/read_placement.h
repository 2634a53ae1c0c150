// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/json_fields.h"

namespace pdsm {

/// The placement that `scale`, `rotate` and `translate` of an entry tell. Throws as JsonFields does.
[[nodiscard]] glm::dmat4 read_placement(const JsonFields& fields);

}  // namespace pdsm
