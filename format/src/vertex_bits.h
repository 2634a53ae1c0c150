// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pdsm/format/penumbra_map.h"

/// Packing of one vertex, inline for loops over many: a little-endian bit string of depth, begin, end.
namespace pdsm {

/// `count` (1 .. 32) bits of a little-endian bit string from bit `position` on.
[[nodiscard]] inline std::uint32_t load_bits(const std::uint32_t* words, std::uint32_t position,
                                             std::uint32_t count) {
  const std::uint32_t index = position / 32, shift = position % 32;
  std::uint64_t bits = words[index];
  if (shift + count > 32) bits |= std::uint64_t{words[index + 1]} << 32;
  return static_cast<std::uint32_t>((bits >> shift) & ((std::uint64_t{1} << count) - 1));
}

/// Sets `count` bits that are 0 so far.
inline void store_bits(std::uint32_t* words, std::uint32_t position, std::uint32_t count,
                       std::uint32_t value) {
  const std::uint32_t index = position / 32, shift = position % 32;
  const std::uint64_t bits = std::uint64_t{value} << shift;
  words[index] |= static_cast<std::uint32_t>(bits);
  if (shift + count > 32) words[index + 1] |= static_cast<std::uint32_t>(bits >> 32);
}

[[nodiscard]] inline FunctionVertex load_vertex(const VertexCoding& coding, const std::uint32_t* words) {
  const std::uint32_t begin_at = coding.depth_bits;
  const std::uint32_t end_at = begin_at + coding.value_bits;
  return {load_bits(words, 0, coding.depth_bits), load_bits(words, begin_at, coding.value_bits),
          load_bits(words, end_at, coding.value_bits)};
}

inline void store_vertex(const VertexCoding& coding, const FunctionVertex& vertex, std::uint32_t* words) {
  const std::uint32_t begin_at = coding.depth_bits;
  const std::uint32_t end_at = begin_at + coding.value_bits;
  for (std::uint32_t word = 0; word < coding.words_per_vertex(); ++word) words[word] = 0;
  store_bits(words, 0, coding.depth_bits, vertex.depth);
  store_bits(words, begin_at, coding.value_bits, vertex.begin);
  store_bits(words, end_at, coding.value_bits, vertex.end);
}

}  // namespace pdsm
