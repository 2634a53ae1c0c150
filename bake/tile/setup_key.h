// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pdsm/bake/map_key.h"
#include "tile/bake_job.h"

namespace pdsm {

/// The key of a map (pdsm/bake/map_key.h) that `isa` bakes from this setup, for `light`.
[[nodiscard]] std::string setup_key(const BakeSetup& setup, const Light& light, const std::string& isa,
                                    const std::string& version = kToolVersion);

}  // namespace pdsm
