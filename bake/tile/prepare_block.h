// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tile/bake_tile.h"
#include "tile/tile_block.h"

namespace pdsm {

/// Finds out what receivers have to do with a block whose rectangle and number are given: domain ends, bands
/// and, where keys are asked for, its key. Any thread.
void prepare_block(const TileInput& input, TileBlock& block);

}  // namespace pdsm
