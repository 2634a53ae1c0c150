// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trace/caster_triangles.h"
#include "trace/sample_map.h"

namespace pdsm {

/// What is nearest at each texel of one sample's map: the greater half of a key orders by depth, the lower
/// is the triangle's id. So the least key wins, whatever the order.
struct DepthImage {
  static constexpr std::uint64_t kNothing = std::numeric_limits<std::uint64_t>::max();

  TexelRect rect;
  std::int32_t pitch = 0;
  std::vector<std::uint64_t> keys;

  void reset(const TexelRect& texels) {
    rect = texels;
    pitch = texels.x1 - texels.x0;
    keys.assign(texels.area(), kNothing);
  }
  /// Bytes that reset(texels) takes.
  [[nodiscard]] static std::uint64_t bytes_for(const TexelRect& texels) {
    return texels.area() * sizeof(std::uint64_t);
  }
  [[nodiscard]] std::uint64_t key(std::int32_t x, std::int32_t y) const {
    return keys[static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(pitch) +
                static_cast<std::size_t>(x - rect.x0)];
  }
};

/// The greater half of a key at depth k (CasterTriangles): grows with k, which is not NaN, and is not 0.
[[nodiscard]] inline std::uint32_t depth_order(float k) {
  const auto bits = std::bit_cast<std::uint32_t>(k);
  return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}
/// k of a key.
[[nodiscard]] inline float key_k(std::uint64_t key) {
  const auto order = static_cast<std::uint32_t>(key >> 32);
  return std::bit_cast<float>(order ^ (order >> 31 != 0 ? 0x80000000u : 0xffffffffu));
}
[[nodiscard]] inline std::uint32_t key_id(std::uint64_t key) {
  return static_cast<std::uint32_t>(key);
}

/// Moves G to one sample's map, where texel centres are whole numbers: g = G + scale k - shift.
struct SampleShift {
  std::array<float, 2> scale{}, shift{};
};

/// Enters the triangles of a chunk at all texels of `image` whose centres they cover. A centre on an edge is
/// covered by both triangles that share it: nothing slips through. Slots `left_out` are passed over. SIMD of
/// the widest kind this machine has; the image is the same for all, as each step is rounded in the same way.
void enter_chunk(const CasterTriangles& casters, std::uint32_t chunk, const SampleShift& shift,
                 std::span<const std::uint32_t> left_out, DepthImage& image);

}  // namespace pdsm
