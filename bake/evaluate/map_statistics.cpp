// SPDX-License-Identifier: Apache-2.0
#include "evaluate/map_statistics.h"

#include <algorithm>

namespace pdsm {

MapStatistics map_statistics(const PenumbraMap& map) {
  MapStatistics total;
  for (const FunctionImage& image : map.images) {
    for (const FunctionBlock& block : image.blocks) {
      for (std::size_t texel = 0; texel + 1 < block.first.size(); ++texel) {
        const std::uint64_t pieces = block.first[texel + 1] - block.first[texel];
        ++total.texels;
        total.empty_texels += pieces == 0 ? 1 : 0;
        total.pieces += pieces;
        total.longest = std::max(total.longest, pieces);
      }
    }
  }
  return total;
}

}  // namespace pdsm
