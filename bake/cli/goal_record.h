// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "choose/search.h"

/// What is written down about goals: in the map for good, in the report for those who run it.
namespace pdsm {

/// The goals that were given.
[[nodiscard]] nlohmann::ordered_json asked_json(const Goals& goals);

/// For the map's metadata, key "achieved": the error of this map and how it was measured.
[[nodiscard]] nlohmann::ordered_json achieved_json(const ChosenBake& chosen);

/// For the report, key "goal": what was asked, each trial, what was chosen and why.
[[nodiscard]] nlohmann::ordered_json goal_json(const ChosenBake& chosen);

}  // namespace pdsm
