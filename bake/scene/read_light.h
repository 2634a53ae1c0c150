// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// One element of a scene file's "lights". A light without a name is called light1, light2, ... by its
/// place. A distant one has no position yet. Throws Error (input) "file:lights[index].field: reason".
[[nodiscard]] Light read_light(const nlohmann::json& node, const std::string& file, std::size_t index);

}  // namespace pdsm
