// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pdsm/bake/bake.h"
#include "trace/sample_map.h"
#include "walk/map_grid.h"

namespace pdsm {

/// Tiles of a bake and what they take. A tile is baked by all threads together: they share its samples.
struct TilePlan {
  std::uint32_t edge = 0;        ///< texels, a multiple of kBlockSize
  std::vector<TexelRect> tiles;  ///< texels of the map, row by row
  double tile_seconds = 0;       ///< that the largest tile takes, roughly
  std::uint64_t rays = 0;
  std::uint64_t map_bytes = 0;     ///< what all threads own: sample maps, blocks being fitted
  std::uint64_t event_limit = 0;   ///< bytes that the events of a tile may take
  std::uint64_t output_bytes = 0;  ///< encoded blocks, estimated
  std::uint32_t strips = 1;        ///< parts of a tile for one sample, when samples are few
};

/// What plans depend on.
struct PlanInput {
  const MapGrid& grid;
  std::span<const LightSample> samples;
  Walk walk;
  std::uint32_t threads;
  std::uint64_t memory;                 ///< bytes
  std::uint32_t edge;                   ///< 0: choose
  std::uint32_t mip_levels = 0;         ///< above 0
  std::optional<TexelRect> share = {};  ///< whole blocks that are baked; default all
  std::uint32_t layers = 0;             ///< that a map texel may have before what is opaque
};

/// The tiles that trace the fewest rays within `memory`: small tiles waste rays on margins, large ones
/// need room for events. Tiles that would take long are cut further where that hardly costs rays, so that
/// an interrupted bake loses little. Throws Error (resource) when the smallest tile does not fit.
[[nodiscard]] TilePlan plan_tiles(const PlanInput& input);

/// The map texels that `rays` (texels) need of one sample's map.
[[nodiscard]] TexelRect sample_footprint(const MapGrid& grid, const LightSample& sample, Walk walk,
                                         const TexelRect& rays);

}  // namespace pdsm
