// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pdsm/bake/bake.h"
#include "tile/bake_facts.h"

namespace pdsm {

/// What a bake modelled and what it left out, with the reasons and what leaving it out saved.
[[nodiscard]] std::vector<ModelledFeature> list_modelled_features(const MapFacts& map,
                                                                  const BlockCounts& done);

}  // namespace pdsm
