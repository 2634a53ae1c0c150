// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "prepared_view.h"
#include "shader_functions.h"

/// The functions that a filter reads at a point, together.
namespace pdsm {

/// The vertices of one function, one or more.
struct FunctionRange {
  const std::uint32_t* words;
  std::uint32_t count;
};

/// One vertex of any coding: the function that is 0 everywhere.
inline constexpr std::uint32_t kNoShadow[3] = {0, 0, 0};

/// The function of a texel.
template <typename Vertices>
FunctionRange function_of(const LevelImage& image, std::uint32_t x, std::uint32_t y) {
  const TexelAddress texel = image.address(x, y);
  const std::uint32_t first = texel.block->first[texel.index],
                      count = texel.block->first[texel.index + 1] - first;
  const std::uint32_t* words = texel.block->words + std::size_t{first} * Vertices::kStride;
  return {count == 0 ? kNoShadow : words, std::max(count, 1U)};
}

/// The values of the functions at z, as real-valued codes: the bits of pdsm_evaluate in pdsm.glsl. Its search
/// runs for all at once, for as many steps as the longest function needs. Which way a search goes can't be
/// foreseen, so nothing branches but the end.
template <typename Vertices, std::size_t Count>
std::array<double, Count> evaluate_group(const std::array<FunctionRange, Count>& functions, CodeDepth z) {
  std::array<std::uint32_t, Count> piece{}, count{};
  std::uint32_t longest = 0;
  for (std::size_t f = 0; f < Count; ++f) {
    count[f] = functions[f].count;
    longest = std::max(longest, count[f]);
  }
  for (; longest > 1; longest -= longest / 2) {
    for (std::size_t f = 0; f < Count; ++f) {
      const std::uint32_t half_count = count[f] / 2, middle = piece[f] + half_count;
      piece[f] = Vertices{functions[f].words}.depth(middle) <= z.whole ? middle : piece[f];
      count[f] -= half_count;
    }
  }

  std::array<double, Count> values{};
  for (std::size_t f = 0; f < Count; ++f) {
    const Vertices vertices{functions[f].words};
    const std::uint32_t at = piece[f], depth = vertices.depth(at);
    // Before the first vertex a function is 0, from the last one on it is level: pieces from 0 to 0, and from
    // begin to begin, of some length.
    const bool is_before = depth > z.whole, is_last = at + 1 == functions[f].count;
    const std::uint32_t next_depth = vertices.depth(at + (is_last ? 0 : 1)) + (is_last ? 1 : 0);
    const std::uint32_t begin = is_before ? 0 : vertices.begin(at);
    const std::uint32_t end = is_before || is_last ? begin : vertices.end(at);
    values[f] = shader::PlainFunctions().pdsm_piece(depth, next_depth, begin, end, {z.whole, z.fraction});
  }
  return values;
}

}  // namespace pdsm
