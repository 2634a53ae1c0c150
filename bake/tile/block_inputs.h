// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "tile/bake_job.h"
#include "tile/list_hash.h"
#include "tile/tile_block.h"

namespace pdsm {

/// The casters in reach of a block, or some of them.
struct BlockCasters {
  ListHash casters;
  /// What one leaves in maps is found by rays: it has holes, lets light through, or its slope may be limited
  /// (tile/steep_casters.h).
  bool is_traced = false;

  /// Appends those that come next in the scene.
  void append(const BlockCasters& next) {
    casters.append(next.casters);
    is_traced = is_traced || next.is_traced;
  }
};

/// What the bytes of each block of a bake depend on, as hashes (docs/architecture.md, "Block keys"): what all
/// blocks share, and for each the casters that may darken its rays, in the scene's order. How receivers act
/// on a block is in its domain ends and bands, which are part of the key as they came out: which triangle a
/// ray meets on an edge may depend on what else is in the BVH.
class BlockInputs {
 public:
  /// Whether keys can be told at all: maps are projected.
  [[nodiscard]] static bool are_known(const BakeJob& job);

  /// One pass over all casters. are_known() must hold.
  BlockInputs(const BakeJob& job, const Light& light);

  /// Whether a block gets a key.
  [[nodiscard]] bool can_tell(std::uint32_t block) const { return !casters_[block].is_traced; }
  /// BlockKey::inputs of a block whose domain ends and bands have been found: unknown where slopes in its
  /// reach may be limited, by rays. Any thread.
  [[nodiscard]] std::array<std::uint64_t, 2> key(const TileBlock& block) const;

 private:
  std::array<std::uint64_t, 2> shared_;
  std::vector<BlockCasters> casters_;  ///< by block
};

/// Where the options ask for keys, or for blocks of a map of before, and keys can be told; else null.
[[nodiscard]] std::unique_ptr<BlockInputs> find_block_inputs(const BakeJob& job, const Light& light);

}  // namespace pdsm
