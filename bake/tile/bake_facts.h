// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pdsm/bake/bake.h"
#include "tile/bake_job.h"
#include "tile/bake_tile.h"

namespace pdsm {

/// What is known of the bake of one channel of one view before its first tile: with the blocks and their
/// counts, all that there is to say about the result. The same for all shards of a bake.
struct BakeFacts {
  std::uint32_t channels = 1;  ///< of the map
  FittedView fitted;
  VertexCoding coding;
  std::vector<LightSample> samples;
  std::uint32_t mip_levels = 0, mip_levels_asked = 0;  ///< above 0
  std::uint32_t map_width = 0, map_height = 0;         ///< texels of each sample map over the window
  double epsilon = 0, depth_tolerance = 0, bias = 0;
  Walk walk = Walk::exact;
  Receivers receivers = Receivers::volume;
  std::string isa;
  bool has_shadows = true;   ///< some function may be other than empty
  bool is_projected = true;  ///< maps are projected, not traced
  bool shift_law = true;
  bool has_emission = false;      ///< the light has a picture
  bool has_cutouts = false;       ///< some caster that the light can see has holes
  bool has_translucency = false;  ///< some caster that the light can see lets light through
  bool has_volumes = false;       ///< it sees some volume
  bool has_curves = false;        ///< it sees some curves
  bool has_block_keys = false;
  double slope_limit_from = 0;  ///< SlopeLimit; infinite where no slope is limited
  std::uint64_t dropped_triangles = 0;
};

/// The same of all channels of all views of a map, in the order of its images; light samples are those of
/// the first.
using MapFacts = std::vector<BakeFacts>;

[[nodiscard]] BakeFacts gather_facts(const BakeJob& job);

/// The map without its blocks and metadata.
[[nodiscard]] PenumbraMap make_map_frame(const MapFacts& facts);

/// The fitted view that is told of a map: the first, with nothing in it only where that holds of all.
[[nodiscard]] FittedView sum_up_views(const std::vector<FittedView>& fitted);
[[nodiscard]] FittedView sum_up_views(const MapFacts& facts);

/// All of a report but for seconds, tiles and memory. `taken` is of the blocks that `done` counts.
[[nodiscard]] BakeReport make_report(const MapFacts& facts, const BlockCounts& done,
                                     const TileStatistics& taken);

/// Of casters before the near of some of several views.
[[nodiscard]] std::vector<std::string> view_warnings(const std::vector<FittedView>& fitted);

/// Of geometry that a bake left out.
[[nodiscard]] std::vector<std::string> geometry_warnings(std::uint64_t dropped_triangles);

/// Adds the threads' seconds of `taken` to a report, as wall-clock of so many threads.
void add_seconds(const TileStatistics& taken, double threads, BakeReport& report);

}  // namespace pdsm
