// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/bake_options.h"

namespace pdsm {

/// A share as the command line gives it: "I/N". Throws Error (usage).
[[nodiscard]] Share parse_share(const std::string& text);

/// Throws Error (usage) for options that do not go with --shard.
void check_shard(const BakeCommand& command);

/// `pdsm bake --shard`: bakes the share of the one light that is chosen and writes the shard.
void run_shard_bake(const BakeCommand& command, const Scene& scene);

}  // namespace pdsm
