// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Mip levels of a view that look-ups use: those that all its layers have, while min(width, height) >> level
/// is at least 1. In textures, no others would lie beside level 0.
[[nodiscard]] inline std::uint32_t level_count(const PenumbraMap& map, std::uint32_t view) {
  const View& base = map.views[view];
  auto levels = static_cast<std::uint32_t>(std::bit_width(std::min(base.width, base.height)));
  for (std::uint32_t layer = 0; layer < map.layers.size(); ++layer) {
    std::uint32_t found = 0;
    for (const FunctionImage& image : map.images)
      if (image.layer == layer && image.view == view && image.level == found) ++found;
    levels = std::min(levels, found);
  }
  return levels;
}

}  // namespace pdsm
