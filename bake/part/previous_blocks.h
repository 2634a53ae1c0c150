// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tile/bake_job.h"
#include "tile/tile_run.h"

namespace pdsm {

/// Gives the blocks of the job's previous map (BakeOptions::previous) to `sink` that would come out of this
/// bake too, and has `run` leave them out; those that it leaves out already are passed over. `input` must ask
/// for keys. Returns how many. Safe on a file of any bytes: a block counts when its inputs are those of this
/// bake and its functions those that its key was made for.
std::uint64_t take_over_previous(const BakeJob& job, const TileInput& input, TileRun& run,
                                 const BlockSink& sink);

}  // namespace pdsm
