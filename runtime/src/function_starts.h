// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Where shadow can begin, two bytes a texel: most points lie before it, or where no function has a vertex,
/// and need no function then.
class FunctionStarts {
 public:
  FunctionStarts() = default;
  FunctionStarts(const VertexCoding& coding, const FunctionImage& image);

  /// Whether the functions of texels (x, y), (x + 1, y), (x, y + 1) and (x + 1, y + 1), as far as the image
  /// goes, are all known to be 0 from near to depth code `whole`. `DepthBits` as in the coding.
  template <std::uint32_t DepthBits>
  [[nodiscard]] bool are_lit(std::uint32_t x, std::uint32_t y, std::uint32_t whole) const {
    return whole >> (DepthBits - 16) < starts_[std::size_t{y} * width_ + x];
  }

 private:
  std::uint32_t width_ = 0;
  /// The upper 16 bits of the least depth code of the four functions; all ones where they are empty.
  std::vector<std::uint16_t> starts_;
};

}  // namespace pdsm
