// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/bake.h"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "events/event_log.h"
#include "part/bake_identity.h"
#include "part/checkpoint_log.h"
#include "part/logged_blocks.h"
#include "tile/bake_blocks.h"
#include "tile/bake_job.h"
#include "tile/map_blocks.h"
#include "tile/modelled_features.h"
#include "tile/tile_run.h"

namespace pdsm {
namespace {

/// Samples of a prediction's trial.
constexpr std::uint32_t kTrialSamples = 4;

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

BakeReport make_report(const BakeJob& job, const TileStatistics& taken, const BlockCounts& done,
                       std::uint64_t tiles, double start) {
  BakeReport report;
  const double threads = job.options.threads;
  report.seconds_bvh = job.seconds_bvh;
  report.seconds_trace = taken.trace / threads;
  report.seconds_walk = taken.walk / threads;
  report.seconds_accumulate = taken.accumulate / threads;
  report.seconds_fit = taken.fit / threads;
  report.seconds_total = omp_get_wtime() - start;
  report.rays = taken.rays;
  report.events = done.events;
  report.texels = std::uint64_t{job.grid.texels[0]} * job.grid.texels[1];
  report.pieces = done.pieces;
  report.empty_texels = done.empty_texels;
  report.tiles = tiles;
  report.mip_levels = job.mip_levels;
  report.peak_event_bytes = taken.event_bytes;
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
  report.mean_slope_bias = taken.rays == 0 ? 0 : taken.slope_bias_sum / static_cast<double>(taken.rays);
  report.max_slope_bias = taken.slope_bias_max;
  report.walk = job.options.walk;
  report.isa = job.options.isa;
  report.modelled = list_modelled_features(job, done);
  if (job.light_space.dropped_triangles > 0) {
    report.warnings.push_back(std::to_string(job.light_space.dropped_triangles) +
                              " triangles without finite coordinates left out");
  }
  return report;
}

}  // namespace

BakedMap bake(const Scene& scene, const Light& light, const BakeOptions& options,
              const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  const double start = omp_get_wtime();
  if (callbacks.progress) callbacks.progress({"bvh", 0, 0});
  const BakeJob job(scene, light, options);
  BakedMap baked;
  baked.map = make_map_frame(job);
  baked.fitted = job.fitted;
  MapBlocks blocks(job.rules.coding, baked.map.images);
  const TileInput input = job.tile_input();
  CheckpointLog* log = checkpoint != nullptr ? &checkpoint->log() : nullptr;
  TileRun run(job, input, logged_output(job, blocks, callbacks, log));
  TileStatistics taken;
  if (log != nullptr) taken = take_over(*log, {bake_identity(scene, job)}, job, run, blocks);
  run.run();
  taken.add(run.statistics());
  baked.blocks = blocks.release();
  baked.report = make_report(job, taken, run.counts(), run.tiles(), start);
  return baked;
}

void bake_blocks(const BakeJob& job, const BlockSink& sink, const BakeCallbacks& callbacks) {
  const TileInput input = job.tile_input();
  TileRun(job, input, {sink, callbacks}).run();
}

BakePrediction predict_bake(const Scene& scene, const Light& light, const BakeOptions& options) {
  const BakeJob job(scene, light, options);
  const auto count = static_cast<std::uint32_t>(job.samples.size());
  const std::uint32_t stride = std::max(1u, count / kTrialSamples);
  const TileInput trial = job.tile_input(stride);
  const double scale = static_cast<double>(count) / static_cast<double>(trial.samples.size());
  // The trial's blocks are encoded as a bake's are, then dropped.
  MapBlocks blocks(job.rules.coding, make_map_frame(job).images);
  TileRun run(job, trial, {[&](FittedBlock&& block) { blocks.take(std::move(block)); }, {}});
  run.run();
  const TileStatistics& done = run.statistics();
  const double per_sample = (done.trace + done.walk + done.accumulate + done.fit) / job.options.threads;
  BakePrediction prediction;
  prediction.rays = static_cast<std::uint64_t>(static_cast<double>(done.rays) * scale);
  prediction.events = static_cast<std::uint64_t>(static_cast<double>(run.counts().events) * scale);
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
