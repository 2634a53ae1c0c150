// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fit/tube.h"
#include "pdsm/format/penumbra_map.h"
#include "trace/sample_map.h"
#include "walk/ray_packets.h"

namespace pdsm {

/// One block of the tile, with all that its rays need.
struct TileBlock {
  TexelRect rect;           ///< texels of the map
  std::uint32_t index = 0;  ///< in the map
  std::vector<float> domain_ends;
  std::vector<RayPacket> packets;  ///< by the shift law only
  std::vector<float> walk_ends;    ///< else: domain ends, before near where nothing can darken the ray
  std::vector<std::vector<CodeBand>> bands;  ///< by texel; with Receivers::surfaces only
  std::array<std::uint64_t, 2> inputs{};     ///< BlockKey::inputs
};

/// What is counted block by block: the sums over a map do not depend on its tiles.
struct BlockCounts {
  std::uint64_t events = 0;
  std::uint64_t pieces = 0, empty_texels = 0;  ///< of level 0
  std::uint64_t undarkened_texels = 0;         ///< whose rays were left out: nothing can darken them

  void add(const BlockCounts& other) {
    events += other.events;
    pieces += other.pieces;
    empty_texels += other.empty_texels;
    undarkened_texels += other.undarkened_texels;
  }
  friend bool operator==(const BlockCounts&, const BlockCounts&) = default;
};

/// The functions of one block.
struct FittedBlock {
  std::uint32_t index = 0;              ///< in the map
  std::uint32_t width = 0, height = 0;  ///< texels
  /// levels[0] is the block; levels[l] has its width >> l x height >> l texels of mip level l, row by row.
  std::vector<FunctionBlock> levels;
  BlockCounts counts;
  std::array<std::uint64_t, 2> inputs{};  ///< BlockKey::inputs
};

}  // namespace pdsm
