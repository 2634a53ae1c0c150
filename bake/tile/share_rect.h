// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/shard.h"
#include "trace/sample_map.h"
#include "walk/map_grid.h"

namespace pdsm {

/// The texels of a share: whole blocks. Shares cover the map, each block once, in rectangles of about the
/// same number of blocks: a plan takes the same time for each block, margins aside, and squarer ones have
/// less of those. Throws Error (usage) where there are more shares than blocks.
[[nodiscard]] TexelRect share_rect(const MapGrid& grid, const Share& share);

}  // namespace pdsm
