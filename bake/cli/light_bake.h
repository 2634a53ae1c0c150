// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/map_jobs.h"
#include "evaluate/verify.h"

namespace pdsm {

/// What became of one light.
struct LightOutcome {
  enum class Status { baked, unchanged, skipped, failed };

  const MapJob* job = nullptr;
  Status status = Status::baked;
  std::string reason;  ///< why it was skipped, or failed
  int exit_code = 0;   ///< of a failure
  std::string key;
  double seconds = 0;
  std::uint64_t bytes = 0, rays = 0, pieces = 0;
  std::uint64_t blocks = 0, blocks_taken_over = 0;  ///< of level 0; from the map of before
  std::optional<View> view;                         ///< of the map
  std::optional<VerifyResult> error;                ///< with --verify
  nlohmann::ordered_json report;                    ///< for --report
};

[[nodiscard]] const char* status_name(LightOutcome::Status status);

/// What all lights of a command share.
struct LightBakeInput {
  const BakeCommand& command;
  const Scene& scene;
  bool is_level = false;
  double seconds_load = 0;
};

/// Warnings on stderr, unless the command is quiet; with --warnings-as-errors the first is thrown as Error
/// (input). `where` may be empty.
void tell_warnings(const BakeCommand& command, const std::string& where,
                   const std::vector<std::string>& warnings);

/// Makes one map, unless the one that is there has the same key, or (in a level) the light reaches nothing.
/// `time_share`: of --time-budget. Throws Error and GoalMissed; then no file has been touched.
[[nodiscard]] LightOutcome bake_light(const LightBakeInput& input, const MapJob& job,
                                      std::optional<double> time_share);

}  // namespace pdsm
