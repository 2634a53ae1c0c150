// SPDX-License-Identifier: Apache-2.0
#include "tile/tile_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "events/event_log.h"
#include "pdsm/format/error.h"
#include "trace/layer_map.h"
#include "trace/triangle_kernel.h"
#include "walk/general_walk.h"
#include "walk/shift_walk.h"

namespace pdsm {
namespace {

/// Events per ray and sample that a plan expects. The dragon has 0.3 on average, a forest of thin things
/// more; a tile that has more than its share is split and baked again.
constexpr double kExpectedEvents = 0.5;
/// The same for each layer of a map texel; the smoke of tests/bench has 0.1.
constexpr double kEventsPerLayer = 0.2;
/// Encoded bytes per texel that a plan sets aside; the dragon needs 6 at epsilon 0.02.
constexpr std::uint64_t kOutputBytesPerTexel = 8;
/// The same of the mip levels, and what their parts take while they wait for their blocks; the dragon needs
/// 3 and 13.
constexpr std::uint64_t kLevelBytesPerTexel = 24;
/// Allocator slack and tables of a thread, besides the events of the block that it fits.
constexpr std::uint64_t kThreadOverhead = std::uint64_t{1} << 20;
/// Bytes per event of a block being fitted: its key, the step it makes, and the tube's runs around that.
constexpr double kFitBytesPerEvent = 8;
/// The same for a block with mip levels: the keys of the next level, and for each event of one texel of the
/// last level its step (8), where that opens and closes (16) and is queued (8), and two runs (48).
constexpr double kMergeBytesPerEvent = 4, kLevelFitBytesPerEvent = 80;
/// Tasks per thread below which a tile's samples are cut into strips.
constexpr std::uint32_t kLeastTasksPerThread = 4;
constexpr std::uint32_t kLargestTile = 4096;
/// Map texels that a walk may cross along one axis; the dragon's cross 50.
constexpr double kLongestWalk = 1 << 16;

/// Seconds after which a tile should have ended: what an interrupted bake may lose.
constexpr double kLongestTile = 60;
/// What ending sooner may cost: the work of all tiles, by that of the tiles that memory allows.
constexpr double kMostGrowth = 1.25;
/// Seconds of one thread: a map texel that is looked at (projected 0.03e-6 on the dragon, traced 0.09e-6), a
/// step of a walk, and the events of a texel and sample until they are fitted.
constexpr double kSecondsPerRay = 0.06e-6, kSecondsPerStep = 0.2e-9, kSecondsPerFunction = 0.02e-6;

std::uint32_t round_up_to_block(std::uint32_t texels) {
  return blocks_along(texels) * kBlockSize;
}

/// The texels that are baked.
TexelRect planned_texels(const PlanInput& input) {
  return input.share.value_or(TexelRect{0, 0, static_cast<std::int32_t>(input.grid.texels[0]),
                                        static_cast<std::int32_t>(input.grid.texels[1])});
}

std::vector<TexelRect> cut_tiles(const TexelRect& all, std::uint32_t edge) {
  const auto step = static_cast<std::int32_t>(edge);
  std::vector<TexelRect> tiles;
  for (std::int32_t y = all.y0; y < all.y1; y += step) {
    for (std::int32_t x = all.x0; x < all.x1; x += step) {
      tiles.push_back({x, y, std::min(x + step, all.x1), std::min(y + step, all.y1)});
    }
  }
  return tiles;
}

/// Bytes of a thread for each event of a block of `block_texels` that it fits.
double fit_bytes_per_event(std::uint32_t mip_levels, double block_texels) {
  if (mip_levels == 0) return kFitBytesPerEvent;
  const double share = std::min(1.0, std::ldexp(1.0, 2 * static_cast<int>(mip_levels)) / block_texels);
  return kFitBytesPerEvent + kMergeBytesPerEvent + share * kLevelFitBytesPerEvent;
}

std::uint64_t estimate_output(const PlanInput& input) {
  const TexelRect all = planned_texels(input);
  const auto width = static_cast<std::uint64_t>(all.x1 - all.x0),
             height = static_cast<std::uint64_t>(all.y1 - all.y0);
  std::uint64_t bytes = width * height * kOutputBytesPerTexel;
  for (std::uint32_t level = 1; level <= input.mip_levels; ++level)
    bytes += (width >> level) * (height >> level) * kLevelBytesPerTexel;
  return bytes;
}

/// Map texels that one ray crosses, about: what the footprint of `rays` has beyond the rays' own texels.
double steps_of(const MapGrid& grid, const TexelRect& footprint, const TexelRect& rays) {
  const double beyond_x = footprint.x1 - footprint.x0 - (rays.x1 - rays.x0) * grid.ratio[0].maps_per_texel();
  const double beyond_y = footprint.y1 - footprint.y0 - (rays.y1 - rays.y0) * grid.ratio[1].maps_per_texel();
  return 1 + std::max(0.0, beyond_x) + std::max(0.0, beyond_y);
}

/// Of a LayerMap, whose lists may take up to twice their size while they grow.
std::uint64_t layer_bytes(const TexelRect& footprint, std::uint32_t layers) {
  return layers == 0 ? 0 : 2 * footprint.area() * (sizeof(std::uint32_t) + layers * sizeof(Layer));
}

/// Events per ray and sample: each layer may make one.
double expected_events(const PlanInput& input) {
  return kExpectedEvents + kEventsPerLayer * input.layers;
}

TilePlan make_plan(const PlanInput& input, std::uint32_t edge) {
  TilePlan plan;
  plan.edge = edge;
  const TexelRect all = planned_texels(input);
  plan.tiles = cut_tiles(all, edge);
  const TexelRect& first = plan.tiles.front();
  std::uint64_t largest = 0;
  double margin_factor = 0, steps = 0;
  for (const LightSample& sample : input.samples) {
    const TexelRect footprint = sample_footprint(input.grid, sample, input.walk, first);
    const std::uint64_t bytes = SampleMap::bytes_for(footprint, input.grid.ratio[0].fine);
    // What is nearest is found in an image of its own, where maps are projected.
    largest =
        std::max(largest, bytes + DepthImage::bytes_for(footprint) + layer_bytes(footprint, input.layers));
    margin_factor += static_cast<double>(bytes / sizeof(float)) / static_cast<double>(first.area());
    steps += steps_of(input.grid, footprint, first);
  }
  plan.rays = static_cast<std::uint64_t>(margin_factor * static_cast<double>(all.area()));
  plan.tile_seconds = static_cast<double>(first.area()) / input.threads *
                      (kSecondsPerRay * margin_factor + kSecondsPerStep * steps +
                       kSecondsPerFunction * static_cast<double>(input.samples.size()));
  const double block_texels = std::min<double>(kBlockSize * kBlockSize, static_cast<double>(first.area()));
  const double block_events =
      expected_events(input) * block_texels * static_cast<double>(input.samples.size());
  const double fit_bytes = fit_bytes_per_event(input.mip_levels, block_texels) * block_events;
  plan.map_bytes = input.threads * (largest + kThreadOverhead + static_cast<std::uint64_t>(fit_bytes));
  plan.output_bytes = estimate_output(input);
  const std::uint64_t fixed = plan.map_bytes + plan.output_bytes;
  plan.event_limit = input.memory > fixed ? input.memory - fixed : 0;
  const auto tasks = static_cast<std::uint32_t>(input.samples.size());
  plan.strips = std::clamp((kLeastTasksPerThread * input.threads + tasks - 1) / tasks, 1u, edge / kBlockSize);
  return plan;
}

/// Whether a tile's expected events, and the pages that all threads have open, fit.
bool fits(const PlanInput& input, const TilePlan& plan) {
  const std::uint64_t texels = plan.tiles.front().area();
  const double events =
      expected_events(input) * static_cast<double>(texels) * static_cast<double>(input.samples.size());
  const std::uint64_t blocks = texels / (kBlockSize * kBlockSize) + 1;
  const std::uint64_t open_pages = blocks * input.threads * EventLog::kPageEvents * sizeof(PackedEvent);
  return events * sizeof(PackedEvent) + static_cast<double>(open_pages) <=
         static_cast<double>(plan.event_limit);
}

/// Walks grow as 1 / near, or with the depth under a distant light; before they are listed, their length is
/// told from the light's size.
void check_walk_length(const PlanInput& input) {
  const MapGrid& grid = input.grid;
  const double spread =
      grid.perspective() ? 1 / grid.near_depth - 1 / grid.far_depth : grid.far_depth - grid.near_depth;
  double longest = 0;
  for (const LightSample& sample : input.samples) {
    for (std::size_t a = 0; a < 2; ++a) {
      longest = std::max(longest, std::abs(sample.position[a]) * spread / grid.pitch[a]);
    }
  }
  if (longest <= kLongestWalk) return;
  const std::string why =
      grid.perspective()
          ? fmt::format("as near is {:g} m from the light: give a coarser map or a larger near",
                        grid.near_depth)
          : fmt::format("as far is {:g} m behind near: give a coarser map or a smaller angle", spread);
  throw Error(Failure::resource, "--map-resolution",
              fmt::format("walks would cross {} map texels, {}",
                          static_cast<std::int64_t>(std::min(longest, 1e18)), why));
}

/// Cuts the tiles of `plan`, which fit, until one takes no longer than it should.
TilePlan with_short_tiles(const PlanInput& input, TilePlan plan) {
  const auto work = [](const TilePlan& p) {
    return p.tile_seconds / static_cast<double>(p.tiles.front().area());
  };
  const double most_work = kMostGrowth * work(plan);
  while (plan.tile_seconds > kLongestTile && plan.edge > kBlockSize) {
    TilePlan shorter = make_plan(input, round_up_to_block(plan.edge / 2));
    if (work(shorter) > most_work) break;
    plan = std::move(shorter);
  }
  return plan;
}

}  // namespace

TexelRect sample_footprint(const MapGrid& grid, const LightSample& sample, Walk walk, const TexelRect& rays) {
  if (!obeys_shift_law(grid, sample)) return general_footprint(grid, sample, rays);
  ShiftWalk shift;
  shift.list(grid, sample, walk);
  return shift.footprint(rays);
}

TilePlan plan_tiles(const PlanInput& input) {
  check_walk_length(input);
  const TexelRect all = planned_texels(input);
  const std::uint32_t whole =
      round_up_to_block(static_cast<std::uint32_t>(std::max(all.x1 - all.x0, all.y1 - all.y0)));
  if (input.edge != 0) return make_plan(input, std::min(input.edge, whole));
  for (std::uint32_t edge = std::min(whole, kLargestTile); edge > kBlockSize;
       edge = round_up_to_block(edge / 2)) {
    TilePlan plan = make_plan(input, edge);
    if (fits(input, plan)) return with_short_tiles(input, std::move(plan));
  }
  TilePlan plan = make_plan(input, kBlockSize);
  if (plan.event_limit == 0) {
    const std::uint64_t least = (plan.map_bytes + plan.output_bytes) >> 20;
    throw Error(Failure::resource, "--memory",
                "this map needs more than " + std::to_string(least) +
                    "M: less with fewer threads, a coarser map, or casters farther from the light");
  }
  return plan;
}

}  // namespace pdsm
