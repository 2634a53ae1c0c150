// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Vertices of a block, coded with `DepthBits` and `ValueBits`: the compiler folds all shifts.
template <std::uint32_t DepthBits, std::uint32_t ValueBits>
struct PackedVertices {
  static constexpr std::uint32_t kDepthBits = DepthBits;
  static constexpr std::uint32_t kStride = (DepthBits + 2 * ValueBits + 31) / 32;
  const std::uint32_t* words;

  [[nodiscard]] std::uint32_t depth(std::uint32_t n) const { return bits<0, DepthBits>(n); }
  [[nodiscard]] std::uint32_t begin(std::uint32_t n) const { return bits<DepthBits, ValueBits>(n); }
  [[nodiscard]] std::uint32_t end(std::uint32_t n) const { return bits<DepthBits + ValueBits, ValueBits>(n); }

 private:
  template <std::uint32_t Position, std::uint32_t Count>
  [[nodiscard]] std::uint32_t bits(std::uint32_t n) const {
    constexpr std::uint32_t kIndex = Position / 32, kShift = Position % 32;
    const std::uint32_t* vertex = words + std::size_t{n} * kStride;
    constexpr std::uint32_t kMask = ~std::uint32_t{0} >> (32 - Count);
    if constexpr (kShift + Count <= 32) {
      return vertex[kIndex] >> kShift & kMask;
    } else {
      const std::uint64_t value = vertex[kIndex] | std::uint64_t{vertex[kIndex + 1]} << 32;
      return static_cast<std::uint32_t>(value >> kShift) & kMask;
    }
  }
};

/// Calls `action` with a value of the PackedVertices type that `coding` asks for.
template <typename Action>
void with_vertices(const VertexCoding& coding, Action action) {
  if (coding.depth_bits == 16) {
    if (coding.value_bits == 8) return action(PackedVertices<16, 8>{});
    if (coding.value_bits == 16) return action(PackedVertices<16, 16>{});
    return action(PackedVertices<16, 32>{});
  }
  if (coding.value_bits == 8) return action(PackedVertices<32, 8>{});
  if (coding.value_bits == 16) return action(PackedVertices<32, 16>{});
  return action(PackedVertices<32, 32>{});
}

}  // namespace pdsm
