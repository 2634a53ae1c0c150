// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pdsm/bake/map_key.h"
#include "tile/bake_job.h"
#include "tile/key_hash.h"

namespace pdsm {

/// Adds all that a map that `isa` bakes from this setup depends on, but for the scene.
void add_setup(KeyHash& hash, const BakeSetup& setup, const Light& light, const std::string& isa,
               const std::string& version = kToolVersion);

/// The key of a map (pdsm/bake/map_key.h) that `isa` bakes from this setup, for `light`.
[[nodiscard]] std::string setup_key(const BakeSetup& setup, const Light& light, const std::string& isa,
                                    const std::string& version = kToolVersion);

}  // namespace pdsm
