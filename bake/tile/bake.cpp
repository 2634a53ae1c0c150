// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/bake.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "events/event_log.h"
#include "pdsm/format/error.h"
#include "tile/bake_blocks.h"
#include "tile/bake_job.h"
#include "tile/map_blocks.h"
#include "tile/modelled_features.h"
#include "tile/setup_key.h"

namespace pdsm {
namespace {

/// Samples of a prediction's trial.
constexpr std::uint32_t kTrialSamples = 4;

/// Halves a tile along its longer side, at a block border. Empty when it is one block already.
std::vector<TexelRect> split_tile(const TexelRect& tile) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  const std::int32_t across = blocks_along(tile.x1 - tile.x0), up = blocks_along(tile.y1 - tile.y0);
  if (across == 1 && up == 1) return {};
  TexelRect first = tile, second = tile;
  if (across >= up)
    first.x1 = second.x0 = tile.x0 + across / 2 * edge;
  else
    first.y1 = second.y0 = tile.y0 + up / 2 * edge;
  return {first, second};
}

double share_of(const TexelRect& tile, const MapGrid& grid) {
  return static_cast<double>(tile.x1 - tile.x0) / grid.texels[0] * static_cast<double>(tile.y1 - tile.y0) /
         grid.texels[1];
}

/// Bakes all tiles, halving those whose events take too much room.
class TileRun {
 public:
  TileRun(const BakeJob& job, const TileInput& input, BlockSink sink, BakeCallbacks callbacks)
      : job_(job),
        input_(input),
        sink_(std::move(sink)),
        callbacks_(std::move(callbacks)),
        start_(omp_get_wtime()) {}

  TileStatistics run() {
    std::deque<TexelRect> todo(job_.plan.tiles.begin(), job_.plan.tiles.end());
    while (!todo.empty()) {
      const TexelRect tile = todo.front();
      todo.pop_front();
      const double share = share_of(tile, job_.grid);
      const std::uint64_t events_before = statistics_.events;
      const TileOutcome outcome = bake_tile(
          input_, tile, job_.plan.strips, job_.plan.event_limit, sink_,
          [&](double part) { return poll(done_ + share * part); }, statistics_);
      if (outcome == TileOutcome::cancelled) throw Error(Failure::interrupted, "bake", "interrupted");
      if (outcome == TileOutcome::done) {
        largest_events_ = std::max(largest_events_, statistics_.events - events_before);
        done_ += share;
        ++tiles_;
        continue;
      }
      const std::vector<TexelRect> halves = split_tile(tile);
      if (halves.empty())
        throw Error(Failure::resource, "--memory",
                    "too little for the events of one block of 64 x 64 texels");
      todo.insert(todo.begin(), halves.begin(), halves.end());
    }
    return statistics_;
  }

  [[nodiscard]] std::uint64_t tiles() const { return tiles_; }
  /// Of the tile that has most.
  [[nodiscard]] std::uint64_t largest_events() const { return largest_events_; }

 private:
  bool poll(double done) {
    const double now = omp_get_wtime();
    if (callbacks_.progress && now - last_told_ > 0.1) {
      last_told_ = now;
      const double rate = done * static_cast<double>(job_.plan.rays) / std::max(now - start_, 1e-9);
      callbacks_.progress({"bake", done, rate});
    }
    return callbacks_.cancelled && callbacks_.cancelled();
  }

  const BakeJob& job_;
  const TileInput& input_;
  const BlockSink sink_;
  const BakeCallbacks callbacks_;
  TileStatistics statistics_;
  double start_, last_told_ = 0, done_ = 0;
  std::uint64_t tiles_ = 0, largest_events_ = 0;
};

/// The map without its blocks.
PenumbraMap make_map_frame(const BakeJob& job) {
  PenumbraMap map;
  map.views = {job.fitted.view};
  map.coding = job.rules.coding;
  map.samples = job.samples;
  for (std::uint32_t level = 0; level <= job.mip_levels; ++level) {
    FunctionImage& image = map.images.emplace_back();
    image.level = level;
    image.width = job.fitted.view.width >> level;
    image.height = job.fitted.view.height >> level;
  }
  return map;
}

BakeReport make_report(const BakeJob& job, const Light& light, const TileStatistics& done,
                       std::uint64_t tiles, double start) {
  BakeReport report;
  const double threads = job.options.threads;
  report.seconds_bvh = job.seconds_bvh;
  report.seconds_trace = done.trace / threads;
  report.seconds_walk = done.walk / threads;
  report.seconds_accumulate = done.accumulate / threads;
  report.seconds_fit = done.fit / threads;
  report.seconds_total = omp_get_wtime() - start;
  report.rays = done.rays;
  report.events = done.events;
  report.texels = std::uint64_t{job.grid.texels[0]} * job.grid.texels[1];
  report.pieces = done.pieces;
  report.empty_texels = done.empty_texels;
  report.tiles = tiles;
  report.mip_levels = job.mip_levels;
  report.peak_event_bytes = done.event_bytes;
  report.resident_after_bvh = job.resident_after_bvh;
  report.map_width =
      static_cast<std::uint32_t>(std::lround(job.grid.texels[0] * job.grid.ratio[0].maps_per_texel()));
  report.map_height =
      static_cast<std::uint32_t>(std::lround(job.grid.texels[1] * job.grid.ratio[1].maps_per_texel()));
  report.samples = job.options.samples;
  report.tile = job.plan.edge;
  report.epsilon = job.options.epsilon;
  report.depth_tolerance = job.rules.tolerance;
  report.bias = job.bias;
  report.mean_slope_bias = done.rays == 0 ? 0 : done.slope_bias_sum / static_cast<double>(done.rays);
  report.max_slope_bias = done.slope_bias_max;
  report.walk = job.options.walk;
  report.isa = job.options.isa;
  report.key = setup_key(job, light, report.isa);
  report.modelled = list_modelled_features(job, done);
  report.warnings = job.warnings();
  return report;
}

}  // namespace

BakedMap bake(const Scene& scene, const Light& light, const BakeOptions& options,
              const BakeCallbacks& callbacks) {
  const double start = omp_get_wtime();
  if (callbacks.progress) callbacks.progress({"bvh", 0, 0});
  const BakeJob job(scene, light, options);
  BakedMap baked;
  baked.map = make_map_frame(job);
  baked.fitted = job.fitted;
  MapBlocks blocks(job.rules.coding, baked.map.images);
  const TileInput input = job.tile_input();
  TileRun run(
      job, input, [&](FittedBlock&& block) { blocks.take(std::move(block)); }, callbacks);
  const TileStatistics done = run.run();
  baked.blocks = blocks.release();
  baked.report = make_report(job, light, done, run.tiles(), start);
  return baked;
}

void bake_blocks(const BakeJob& job, const BlockSink& sink, const BakeCallbacks& callbacks) {
  const TileInput input = job.tile_input();
  TileRun(job, input, sink, callbacks).run();
}

BakePrediction predict_bake(const Scene& scene, const Light& light, const BakeOptions& options) {
  const BakeJob job(scene, light, options);
  const auto count = static_cast<std::uint32_t>(job.samples.size());
  const std::uint32_t stride = std::max(1u, count / kTrialSamples);
  const TileInput trial = job.tile_input(stride);
  const double scale = static_cast<double>(count) / static_cast<double>(trial.samples.size());
  // The trial's blocks are encoded as a bake's are, then dropped.
  MapBlocks blocks(job.rules.coding, make_map_frame(job).images);
  TileRun run(job, trial, [&](FittedBlock&& block) { blocks.take(std::move(block)); }, {});
  const TileStatistics done = run.run();
  const double per_sample = (done.trace + done.walk + done.accumulate + done.fit) / job.options.threads;
  BakePrediction prediction;
  prediction.rays = static_cast<std::uint64_t>(static_cast<double>(done.rays) * scale);
  prediction.events = static_cast<std::uint64_t>(static_cast<double>(done.events) * scale);
  prediction.seconds = job.seconds_bvh + done.prepare + per_sample * scale;
  const auto tile_events =
      static_cast<std::uint64_t>(scale * static_cast<double>(sizeof(PackedEvent) * run.largest_events()));
  prediction.memory_bytes =
      job.plan.map_bytes + job.plan.output_bytes + std::min(job.plan.event_limit, tile_events);
  prediction.scene_bytes = job.resident_after_bvh;
  prediction.tile = job.plan.edge;
  prediction.tiles = static_cast<std::uint32_t>(job.plan.tiles.size());
  return prediction;
}

PenumbraMap decode_blocks(const BakedMap& baked) {
  PenumbraMap map = baked.map;
  for (std::size_t n = 0; n < map.images.size(); ++n) {
    FunctionImage& image = map.images[n];
    for (std::size_t b = 0; b < baked.blocks[n].size(); ++b) {
      const auto across = image.blocks_across(), index = static_cast<std::uint32_t>(b);
      const auto [width, height] = block_extent(image.width, image.height, index % across, index / across);
      image.blocks.push_back(decode_block(map.coding, width, height, baked.blocks[n][b]));
    }
  }
  return map;
}

}  // namespace pdsm
