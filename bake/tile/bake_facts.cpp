// SPDX-License-Identifier: Apache-2.0
#include "tile/bake_facts.h"

#include <cmath>

#include "tile/block_inputs.h"
#include "tile/modelled_features.h"

namespace pdsm {
namespace {

std::uint64_t count_blocks(const View& view) {
  return std::uint64_t{blocks_along(view.width)} * blocks_along(view.height);
}

std::uint32_t map_texels(const MapGrid& grid, std::size_t axis) {
  return static_cast<std::uint32_t>(std::lround(grid.texels[axis] * grid.ratio[axis].maps_per_texel()));
}

}  // namespace

BakeFacts gather_facts(const BakeJob& job) {
  BakeFacts facts;
  facts.fitted = job.fitted;
  facts.coding = job.rules.coding;
  facts.samples = job.samples;
  facts.mip_levels = job.mip_levels;
  facts.mip_levels_asked = job.options.mip_levels;
  facts.map_width = map_texels(job.grid, 0);
  facts.map_height = map_texels(job.grid, 1);
  facts.epsilon = job.options.epsilon;
  facts.depth_tolerance = job.rules.tolerance;
  facts.bias = job.bias;
  facts.walk = job.options.walk;
  facts.receivers = job.options.receivers;
  facts.isa = job.options.isa;
  facts.has_shadows = job.has_shadows();
  facts.is_projected = !job.casters.empty();
  facts.shift_law = job.shift_law();
  facts.has_emission = job.has_emission;
  facts.has_cutouts = job.light_space.has_cutouts();
  facts.has_translucency = job.light_space.has_translucency();
  facts.has_block_keys = job.options.block_keys && BlockInputs::are_known(job);
  facts.slope_limit_from = job.slope_limit.from;
  facts.dropped_triangles = job.light_space.dropped_triangles;
  return facts;
}

PenumbraMap make_map_frame(const BakeFacts& facts) {
  PenumbraMap map;
  map.views = {facts.fitted.view};
  map.coding = facts.coding;
  map.samples = facts.samples;
  for (std::uint32_t level = 0; level <= facts.mip_levels; ++level) {
    FunctionImage& image = map.images.emplace_back();
    image.level = level;
    image.width = facts.fitted.view.width >> level;
    image.height = facts.fitted.view.height >> level;
  }
  return map;
}

BakeReport make_report(const BakeFacts& facts, const BlockCounts& done, const TileStatistics& taken) {
  BakeReport report;
  report.rays = taken.rays;
  report.events = done.events;
  report.texels = std::uint64_t{facts.fitted.view.width} * facts.fitted.view.height;
  report.pieces = done.pieces;
  report.empty_texels = done.empty_texels;
  report.mip_levels = facts.mip_levels;
  report.blocks = count_blocks(facts.fitted.view);
  report.peak_event_bytes = taken.event_bytes;
  report.map_width = facts.map_width;
  report.map_height = facts.map_height;
  report.samples = static_cast<std::uint32_t>(facts.samples.size());
  report.epsilon = facts.epsilon;
  report.depth_tolerance = facts.depth_tolerance;
  report.bias = facts.bias;
  report.mean_slope_bias = taken.rays == 0 ? 0 : taken.slope_bias_sum / static_cast<double>(taken.rays);
  report.max_slope_bias = taken.slope_bias_max;
  report.walk = facts.walk;
  report.isa = facts.isa;
  report.modelled = list_modelled_features(facts, done);
  report.warnings = geometry_warnings(facts.dropped_triangles);
  return report;
}

std::vector<std::string> geometry_warnings(std::uint64_t dropped_triangles) {
  if (dropped_triangles == 0) return {};
  return {std::to_string(dropped_triangles) + " triangles without finite coordinates left out"};
}

void add_seconds(const TileStatistics& taken, double threads, BakeReport& report) {
  report.seconds_trace += taken.trace / threads;
  report.seconds_walk += taken.walk / threads;
  report.seconds_accumulate += taken.accumulate / threads;
  report.seconds_fit += taken.fit / threads;
}

}  // namespace pdsm
