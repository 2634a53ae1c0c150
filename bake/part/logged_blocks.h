// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "part/checkpoint_log.h"
#include "tile/bake_job.h"
#include "tile/map_blocks.h"
#include "tile/tile_run.h"

/// Blocks on their way into a map, and into a checkpoint.
namespace pdsm {

/// What all blocks of the job have in common.
[[nodiscard]] PartShape part_shape(const BakeJob& job);

/// Puts finished blocks into `blocks` and, unless it is null, into `log`, which must all outlive the run.
[[nodiscard]] TileRunOutput logged_output(const BakeJob& job, MapBlocks& blocks,
                                          const BakeCallbacks& callbacks, CheckpointLog* log);

/// Begins `log`. The blocks that it has already go to `blocks`, and `run` leaves them out. Returns what they
/// took.
[[nodiscard]] TileStatistics take_over(CheckpointLog& log, const PartHeader& header, const BakeJob& job,
                                       TileRun& run, MapBlocks& blocks);

}  // namespace pdsm
