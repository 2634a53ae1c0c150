// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "pdsm/format/penumbra_map.h"
#include "tile/tile_block.h"

namespace pdsm {

/// The key of a block: what it was made from, as it says, and what it is. Pure; any thread.
[[nodiscard]] BlockKey block_key(const FittedBlock& block);

/// The keys of a map, block by block.
class BlockKeyList {
 public:
  /// `blocks`: of level 0; 0 where no keys are asked for.
  explicit BlockKeyList(std::size_t blocks) : keys_(blocks) {}

  /// Any thread; several at once with different blocks.
  void take(const FittedBlock& block) {
    if (!keys_.empty()) keys_[block.index] = block_key(block);
  }
  /// One for each block; none where no block has one. Empties this.
  [[nodiscard]] std::vector<BlockKey> release();

 private:
  std::vector<BlockKey> keys_;
};

}  // namespace pdsm
