// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cli/light_bake.h"

namespace pdsm {

/// Bakes all maps, one after the other; a time budget is for all of them together. In a level, a light that
/// fails for its own reasons is told and the others go on. Throws Error for what concerns all: options,
/// interrupts; without a level as bake_light().
[[nodiscard]] std::vector<LightOutcome> bake_lights(const LightBakeInput& input, const MapJobs& jobs);

/// Writes what a level's bake made. Throws Error (resource).
void write_level_manifest(const std::vector<LightOutcome>& outcomes, const std::filesystem::path& path);

}  // namespace pdsm
