// SPDX-License-Identifier: Apache-2.0
#include "evaluate/map_statistics.h"

#include <algorithm>

namespace pdsm {
namespace {

void add_image(const FunctionImage& image, MapStatistics& total) {
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

}  // namespace

MapStatistics map_statistics(const PenumbraMap& map) {
  MapStatistics total;
  for (const FunctionImage& image : map.images) add_image(image, total);
  return total;
}

MapStatistics level_statistics(const PenumbraMap& map, std::uint32_t level) {
  MapStatistics total;
  for (const FunctionImage& image : map.images) {
    if (image.level == level) add_image(image, total);
  }
  return total;
}

std::uint64_t texture_bytes(const BakedMap& baked) {
  std::uint64_t words = 0;
  for (const auto& blocks : baked.blocks) {
    for (const EncodedBlock& block : blocks)
      words += block.texels + block.vertices * baked.map.coding.words_per_vertex();
  }
  return words * sizeof(std::uint32_t);
}

}  // namespace pdsm
