// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <span>

#include "part/checkpoint_log.h"
#include "tile/bake_job.h"
#include "tile/tile_run.h"

/// Blocks on their way into a result, and into a checkpoint.
namespace pdsm {

/// What all blocks of the job have in common.
/// `first_block`: as PartShape has it.
[[nodiscard]] PartShape part_shape(const BakeJob& job, std::uint32_t first_block = 0);

/// Takes finished blocks with their level 0 encoded. Called from several threads at once, once a block.
using EncodedSink = std::function<void(FittedBlock&& block, EncodedBlock&& base)>;

/// Gives finished blocks to `sink` and, unless it is null, to `log`, which must outlive the run.
[[nodiscard]] TileRunOutput logged_output(const BakeJob& job, const BakeCallbacks& callbacks,
                                          CheckpointLog* log, std::uint32_t first_block, EncodedSink sink);

/// The view's blocks among `records` go to `sink`, and `run` leaves them out; where `input` asks for keys,
/// those without are baked again.
void take_over(std::span<const PartRecord> records, const BakeJob& job, std::uint32_t first_block,
               const TileInput& input, TileRun& run, const BlockSink& sink);

/// What the blocks among `records` took.
[[nodiscard]] TileStatistics taken_by(std::span<const PartRecord> records);

}  // namespace pdsm
