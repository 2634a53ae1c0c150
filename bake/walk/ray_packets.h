// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/sample_map.h"
#include "walk/map_grid.h"

namespace pdsm {

/// Rays of a block that are walked together: neighbours in a row, of the same phase against the map grid,
/// so that their map texels are neighbours too.
struct RayPacket {
  static constexpr std::uint32_t kLanes = 16;
  static constexpr float kUnused = -1;  ///< domain end of a lane that sees no event

  std::int32_t column = 0, row = 0;           ///< i / coarse_x of lane 0, j / coarse_y
  std::uint32_t phase_x = 0, phase_y = 0;     ///< i % coarse_x, j % coarse_y
  float first_end = 0, last_end = 0;          ///< least and greatest domain end of the lanes in use
  std::array<float, kLanes> domain_end{};     ///< or kUnused
  std::array<std::uint16_t, kLanes> texel{};  ///< texel within the block
};

/// The packets of the block at `rect` (texels of the map). `domain_ends` has one value a texel, row by row.
[[nodiscard]] std::vector<RayPacket> make_ray_packets(const MapGrid& grid, const TexelRect& rect,
                                                      std::span<const float> domain_ends);

}  // namespace pdsm
