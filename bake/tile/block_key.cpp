// SPDX-License-Identifier: Apache-2.0
#include "tile/block_key.h"

#include <algorithm>
#include <utility>

#include "tile/key_hash.h"

namespace pdsm {

BlockKey block_key(const FittedBlock& block) {
  KeyHash hash;
  hash.add(std::span(block.inputs));
  hash.add(block.counts.events);
  hash.add(block.counts.undarkened_texels);
  hash.add(std::uint64_t{block.levels.size()});
  for (std::size_t l = 0; l < block.levels.size(); ++l) {
    // A narrow block at the border has no texel of the upper levels.
    if (block.width >> l == 0 || block.height >> l == 0) continue;
    const FunctionBlock& level = block.levels[l];
    hash.add(std::span(level.first));
    hash.add(std::span(level.words));
    hash.add(std::span(level.domain_end));
  }
  return {block.inputs, hash.digest()[1], block.counts.events,
          static_cast<std::uint32_t>(block.counts.undarkened_texels)};
}

std::vector<BlockKey> BlockKeyList::release() {
  if (std::ranges::none_of(keys_, &BlockKey::is_known)) keys_.clear();
  return std::move(keys_);
}

}  // namespace pdsm
