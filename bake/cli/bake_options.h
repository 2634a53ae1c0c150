// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "choose/goals.h"
#include "choose/quality.h"
#include "cli/checkpoint_choice.h"
#include "cli/options.h"
#include "cli/progress_line.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/shard.h"
#include "pdsm/format/map_file.h"

namespace pdsm {

/// The command line of `pdsm bake`. What it leaves open, the light and then the defaults decide.
struct BakeCommand {
  std::string scene, output, report, depfile;
  std::optional<std::string> light;
  std::optional<std::uint32_t> samples;
  std::optional<std::array<std::uint32_t, 2>> resolution, map_resolution;
  std::optional<double> epsilon;
  std::optional<Quality> quality;
  Goals goals;
  BakeOptions options;  ///< everything else
  std::uint32_t verify_points = 4000;
  std::optional<double> max_error;
  std::optional<ProgressStyle> progress;
  CheckpointChoice checkpoint;
  std::optional<Share> shard;
  bool quiet = false, dry_run = false, force = false, verify = false, warnings_as_errors = false;
};

/// How progress is told: as asked for, else as suits stderr.
[[nodiscard]] ProgressStyle progress_style(const BakeCommand& command);

/// Adds the options to `takes`; they write to `command`, which must outlive parsing.
void add_bake_options(Options& takes, BakeCommand& command);

/// The options for one light. With goals, the light's own samples and resolution do not count.
[[nodiscard]] BakeOptions options_for(const BakeCommand& command, const Light& light);

/// What goals must not choose, as the command line gives it.
[[nodiscard]] FixedOptions fixed_options(const BakeCommand& command);

/// Throws Error (usage) for options that do not go together.
void check_goals(const BakeCommand& command);

}  // namespace pdsm
