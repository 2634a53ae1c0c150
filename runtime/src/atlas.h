// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pdsm {

/// Where rectangles lie in a common one.
struct Atlas {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<std::uint32_t, 2>> corners;  ///< of each rectangle, in the order given
};

/// Places rectangles (width, height; texels) in shelves. Neither side of the atlas is made greater than
/// `limit` while that can be helped: the caller checks. One rectangle is an atlas of its own size.
[[nodiscard]] Atlas place_rectangles(std::span<const std::array<std::uint32_t, 2>> sizes,
                                     std::uint32_t limit);

}  // namespace pdsm
