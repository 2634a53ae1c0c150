// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "events/accumulate.h"
#include "events/transmittance_events.h"
#include "fit/fit_function.h"
#include "tile/bake_tile.h"
#include "tile/tile_block.h"

namespace pdsm {

/// What one thread owns while fitting.
struct FitThread {
  BlockEvents events, next_events;     ///< of a level, and of the next
  BlockChanges changes, next_changes;  ///< the same with translucent casters
  std::vector<EventKey> merge_room;    ///< for sorting, too
  StepFunction function;
  FitWorkspace room;
  std::vector<FunctionVertex> vertices;
  TileStatistics statistics;
};

/// Sums up and fits all functions of one block and of its mip levels, from the events that `logs` hold. A
/// level's functions are fitted to their exact means, not to what was fitted before.
[[nodiscard]] FittedBlock fit_block(const TileInput& input, const TileBlock& block,
                                    std::span<const EventLog* const> logs, FitThread& thread);

}  // namespace pdsm
