// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pdsm {

/// Vertices of a block, coded with `DepthBits` and `ValueBits`: the compiler folds all shifts.
template <std::uint32_t DepthBits, std::uint32_t ValueBits>
struct PackedVertices {
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

}  // namespace pdsm
