// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "pdsm/bake/bake.h"
#include "pdsm/format/map_file.h"

namespace pdsm {

/// The command line of `pdsm bake`. What it leaves open, the light and then the defaults decide.
struct BakeCommand {
  std::string scene, output, report;
  std::optional<std::string> light;
  std::optional<std::uint32_t> samples;
  std::optional<std::array<std::uint32_t, 2>> resolution, map_resolution;
  BakeOptions options;  ///< everything else
  bool quiet = false, dry_run = false;
};

/// Puts the options on `sub`; they write to `command`, which must outlive parsing.
void add_bake_options(CLI::App& sub, BakeCommand& command);

/// The options for one light.
[[nodiscard]] BakeOptions options_for(const BakeCommand& command, const Light& light);

}  // namespace pdsm
