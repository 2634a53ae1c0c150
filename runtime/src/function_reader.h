// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Calls visit(x, y, first, count, block) for each texel of an image, row by row: its function has the
/// vertices first .. first + count - 1 of `block`.
template <typename Visitor>
void for_each_function(const FunctionImage& image, Visitor&& visit) {
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::uint32_t bx = x / kBlockSize, by = y / kBlockSize;
      const FunctionBlock& block = image.blocks[std::size_t{by} * image.blocks_across() + bx];
      const std::uint32_t width = block_extent(image.width, image.height, bx, by)[0];
      const std::size_t texel = std::size_t{y % kBlockSize} * width + x % kBlockSize;
      visit(x, y, block.first[texel], block.first[texel + 1] - block.first[texel], block);
    }
  }
}

/// Vertex `n` of a block.
[[nodiscard]] inline FunctionVertex vertex_of(const VertexCoding& coding, const FunctionBlock& block,
                                              std::uint32_t n) {
  return unpack_vertex(coding, block.words.data() + std::size_t{n} * coding.words_per_vertex());
}

}  // namespace pdsm
