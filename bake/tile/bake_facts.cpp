// SPDX-License-Identifier: Apache-2.0
#include "tile/bake_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

std::vector<FittedView> fitted_views(const MapFacts& facts) {
  std::vector<FittedView> fitted;
  for (std::size_t n = 0; n < facts.size(); n += facts[n].channels) fitted.push_back(facts[n].fitted);
  return fitted;
}

}  // namespace

BakeFacts gather_facts(const BakeJob& job) {
  BakeFacts facts;
  facts.channels = job.channels;
  facts.fitted = job.fitted;
  facts.coding = job.rules.coding;
  facts.samples = job.light_samples;
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
  facts.has_curves = !job.light_space.curves.empty();
  facts.has_volumes = !job.light_space.volumes.empty();
  facts.has_block_keys = job.options.block_keys && BlockInputs::are_known(job);
  facts.slope_limit_from = job.slope_limit.from;
  facts.dropped_triangles = job.light_space.dropped_triangles;
  return facts;
}

PenumbraMap make_map_frame(const MapFacts& facts) {
  PenumbraMap map;
  map.coding = facts.front().coding;
  map.samples = facts.front().samples;
  map.channels = facts.front().channels;
  for (std::size_t n = 0; n < facts.size(); ++n) {
    const View& view = facts[n].fitted.view;
    const auto channel = static_cast<std::uint32_t>(n % map.channels);
    if (channel == 0) map.views.push_back(view);
    for (std::uint32_t level = 0; level <= facts[n].mip_levels; ++level) {
      FunctionImage& image = map.images.emplace_back();
      image.view = static_cast<std::uint32_t>(map.views.size() - 1);
      image.channel = channel;
      image.level = level;
      image.width = view.width >> level;
      image.height = view.height >> level;
    }
  }
  return map;
}

FittedView sum_up_views(const std::vector<FittedView>& fitted) {
  FittedView sum = fitted.front();
  for (const FittedView& view : fitted) {
    sum.nothing_casts = sum.nothing_casts && view.nothing_casts;
    sum.nothing_receives = sum.nothing_receives && view.nothing_receives;
    sum.casts_before_near = sum.casts_before_near || view.casts_before_near;
  }
  return sum;
}

FittedView sum_up_views(const MapFacts& facts) {
  return sum_up_views(fitted_views(facts));
}

BakeReport make_report(const MapFacts& views, const BlockCounts& done, const TileStatistics& taken) {
  const BakeFacts& facts = views.front();
  BakeReport report;
  report.rays = taken.rays;
  report.events = done.events;
  for (const BakeFacts& of_view : views) {
    report.texels += std::uint64_t{of_view.fitted.view.width} * of_view.fitted.view.height;
    report.blocks += count_blocks(of_view.fitted.view);
    report.depth_tolerance = std::max(report.depth_tolerance, of_view.depth_tolerance);
    report.bias = std::max(report.bias, of_view.bias);
  }
  report.pieces = done.pieces;
  report.empty_texels = done.empty_texels;
  report.mip_levels = facts.mip_levels;
  report.peak_event_bytes = taken.event_bytes;
  report.map_width = facts.map_width;
  report.map_height = facts.map_height;
  report.samples = static_cast<std::uint32_t>(facts.samples.size());
  report.epsilon = facts.epsilon;
  report.mean_slope_bias = taken.rays == 0 ? 0 : taken.slope_bias_sum / static_cast<double>(taken.rays);
  report.max_slope_bias = taken.slope_bias_max;
  report.walk = facts.walk;
  report.isa = facts.isa;
  report.modelled = list_modelled_features(views, done);
  report.warnings = geometry_warnings(facts.dropped_triangles);
  for (std::string& warning : view_warnings(fitted_views(views)))
    report.warnings.push_back(std::move(warning));
  return report;
}

std::vector<std::string> view_warnings(const std::vector<FittedView>& fitted) {
  const auto count = std::ranges::count_if(fitted, &FittedView::casts_before_near);
  if (count == 0) return {};
  double nearest = 0;
  for (const FittedView& view : fitted)
    if (view.casts_before_near) nearest = std::max(nearest, view.view.near_depth);
  return {
      fmt::format("casters lie before the near, up to {:.3g} m from the light, of {} of {} views: what they "
                  "darken before it is lit in the map",
                  nearest, count, fitted.size())};
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
