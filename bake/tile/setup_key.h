// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

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

/// The key of a map of these views: of one view, as above.
[[nodiscard]] std::string setup_key(std::span<const BakeSetup* const> views, const Light& light,
                                    const std::string& isa, const std::string& version = kToolVersion);

/// Of jobs or setups that something owns.
template <typename Views>
[[nodiscard]] std::string views_key(const Views& views, const Light& light, const std::string& isa,
                                    const std::string& version = kToolVersion) {
  std::vector<const BakeSetup*> setups;
  for (const auto& view : views) setups.push_back(view.get());
  return setup_key(setups, light, isa, version);
}

}  // namespace pdsm
