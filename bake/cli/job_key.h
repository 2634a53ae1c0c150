// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/map_jobs.h"
#include "pdsm/bake/map_key.h"

namespace pdsm {

/// What tells whether a job's map is there already.
struct JobKey {
  /// Of the map. With goals, of one with the options that goals leave, over the whole scene: what chooses the
  /// others looks at all of it.
  MapKey map;
  /// With goals, what a map records of how it was asked for; else null.
  nlohmann::ordered_json asked;
};

/// Throws as map_key().
[[nodiscard]] JobKey job_key(const BakeCommand& command, const Scene& scene, const MapJob& job);

/// The key of the map at `path` where it is just what the job would make, and nothing else.
[[nodiscard]] std::optional<std::string> up_to_date_key(const JobKey& key, const std::filesystem::path& path);

}  // namespace pdsm
