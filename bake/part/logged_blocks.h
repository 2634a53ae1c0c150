// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "part/checkpoint_log.h"
#include "tile/bake_job.h"
#include "tile/tile_run.h"

/// Blocks on their way into a result, and into a checkpoint.
namespace pdsm {

/// What all blocks of the job have in common.
[[nodiscard]] PartShape part_shape(const BakeJob& job);

/// Takes finished blocks with their level 0 encoded. Called from several threads at once, once a block.
using EncodedSink = std::function<void(FittedBlock&& block, EncodedBlock&& base)>;

/// Gives finished blocks to `sink` and, unless it is null, to `log`, which must outlive the run.
[[nodiscard]] TileRunOutput logged_output(const BakeJob& job, const BakeCallbacks& callbacks,
                                          CheckpointLog* log, EncodedSink sink);

/// Begins `log`. The blocks that it has already go to `sink`, and `run` leaves them out; where `input` asks
/// for keys, those without are baked again. Returns what they took.
[[nodiscard]] TileStatistics take_over(CheckpointLog& log, const PartHeader& header, const BakeJob& job,
                                       const TileInput& input, TileRun& run, const BlockSink& sink);

}  // namespace pdsm
