// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Functions of one layer and channel, all levels, are a plane: the channels of layer 0, then those of
/// layer 1.
[[nodiscard]] inline std::uint32_t plane_count(const PenumbraMap& map) {
  return static_cast<std::uint32_t>(map.layers.size()) * map.channels;
}
[[nodiscard]] inline std::uint32_t plane_of(const PenumbraMap& map, const FunctionImage& image) {
  return image.layer * map.channels + image.channel;
}

/// Mip levels of a view that look-ups use: those that all its planes have, while min(width, height) >> level
/// is at least 1. In textures, no others would lie beside level 0.
[[nodiscard]] inline std::uint32_t level_count(const PenumbraMap& map, std::uint32_t view) {
  const View& base = map.views[view];
  auto levels = static_cast<std::uint32_t>(std::bit_width(std::min(base.width, base.height)));
  for (std::uint32_t plane = 0; plane < plane_count(map); ++plane) {
    std::uint32_t found = 0;
    for (const FunctionImage& image : map.images)
      if (plane_of(map, image) == plane && image.view == view && image.level == found) ++found;
    levels = std::min(levels, found);
  }
  return levels;
}

}  // namespace pdsm
