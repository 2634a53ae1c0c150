// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "cli/options.h"
#include "pdsm/bake/checkpoint.h"

namespace pdsm {

/// Whether and how often a bake is saved while it goes on.
struct CheckpointChoice {
  double interval = 10;  ///< seconds
  bool none = false;
};

void add_checkpoint_options(Options& takes, CheckpointChoice& choice);

/// The checkpoint of a bake into `output`: OUTPUT.partial. Null when none is wanted.
[[nodiscard]] std::unique_ptr<Checkpoint> make_checkpoint(const CheckpointChoice& choice,
                                                          const std::filesystem::path& output, bool quiet);

}  // namespace pdsm
