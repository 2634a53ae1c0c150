// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "trace/sample_map.h"
#include "walk/map_grid.h"

/// Blocks of a map by number, row by row.
namespace pdsm {

[[nodiscard]] inline std::uint32_t block_count(const MapGrid& grid) {
  return blocks_along(grid.texels[0]) * blocks_along(grid.texels[1]);
}

/// The block that has texel (x, y).
[[nodiscard]] inline std::uint32_t block_at(const MapGrid& grid, std::int32_t x, std::int32_t y) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  return static_cast<std::uint32_t>(y / edge) * blocks_along(grid.texels[0]) +
         static_cast<std::uint32_t>(x / edge);
}

/// The texels of a block.
[[nodiscard]] inline TexelRect block_rect(const MapGrid& grid, std::uint32_t block) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  const std::uint32_t across = blocks_along(grid.texels[0]);
  const auto x = static_cast<std::int32_t>(block % across) * edge,
             y = static_cast<std::int32_t>(block / across) * edge;
  return {x, y, std::min(x + edge, static_cast<std::int32_t>(grid.texels[0])),
          std::min(y + edge, static_cast<std::int32_t>(grid.texels[1]))};
}

}  // namespace pdsm
