// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/bake.h"

#include <omp.h>

#include <algorithm>

#include "events/event_log.h"
#include "part/checkpoint_log.h"
#include "part/logged_blocks.h"
#include "part/previous_blocks.h"
#include "pdsm/bake/stream.h"
#include "tile/bake_blocks.h"
#include "tile/bake_facts.h"
#include "tile/bake_job.h"
#include "tile/block_inputs.h"
#include "tile/block_key.h"
#include "tile/map_blocks.h"
#include "tile/setup_key.h"
#include "tile/tile_run.h"

namespace pdsm {
namespace {

/// Samples of a prediction's trial.
constexpr std::uint32_t kTrialSamples = 4;

/// Puts a map together from its blocks, and their keys where these are asked for.
class MapTaker {
 public:
  MapTaker(const BakeFacts& facts, std::span<const FunctionImage> images, const BakeStream& stream)
      : is_kept_(!stream.take),
        keys_(facts.has_block_keys ? std::size_t{images.front().blocks_across()} * images.front().blocks_up()
                                   : 0),
        blocks_(facts.coding, images, stream.take) {}

  void take(FittedBlock&& block) {
    keys_.take(block);
    blocks_.take(std::move(block));
  }
  void take(FittedBlock&& block, EncodedBlock&& base) {
    keys_.take(block);
    blocks_.take(std::move(block), std::move(base));
  }
  /// Once all blocks are there.
  void release(BakedMap& baked) {
    baked.map.block_keys = keys_.release();
    if (is_kept_) baked.blocks = blocks_.release();
  }

 private:
  bool is_kept_;
  BlockKeyList keys_;
  MapBlocks blocks_;
};

}  // namespace

BakedMap bake(const Scene& scene, const Light& light, const BakeOptions& options,
              const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  return bake_streamed(scene, light, options, {}, callbacks, checkpoint);
}

BakedMap bake_streamed(const Scene& scene, const Light& light, const BakeOptions& options,
                       const BakeStream& stream, const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  const double start = omp_get_wtime();
  if (callbacks.progress) callbacks.progress({"bvh", 0, 0});
  const BakeJob job(scene, light, options);
  const BakeFacts facts = gather_facts(job);
  const std::string key = setup_key(job, light, job.options.isa);
  BakedMap baked;
  baked.map = make_map_frame(facts);
  baked.fitted = facts.fitted;
  if (stream.begin) {
    baked.report = make_report(facts, {}, {});
    baked.report.key = key;
    stream.begin(baked);
  }
  const auto inputs = find_block_inputs(job, light);
  TileInput input = job.tile_input();
  input.block_inputs = inputs.get();
  MapTaker taker(facts, baked.map.images, stream);
  CheckpointLog* log = checkpoint != nullptr ? &checkpoint->log() : nullptr;
  TileRun run(job, input, logged_output(job, callbacks, log, [&](FittedBlock&& block, EncodedBlock&& base) {
                taker.take(std::move(block), std::move(base));
              }));
  const auto take_whole = [&taker](FittedBlock&& block) { taker.take(std::move(block)); };
  TileStatistics taken;
  if (log != nullptr) taken = take_over(*log, {identity_of(key)}, job, input, run, take_whole);
  const std::uint64_t blocks_taken_over =
      inputs != nullptr ? take_over_previous(job, input, run, take_whole) : 0;
  run.run();
  taken.add(run.statistics());
  taker.release(baked);
  baked.report = make_report(facts, run.counts(), taken);
  baked.report.key = key;
  add_seconds(taken, job.options.threads, baked.report);
  baked.report.seconds_bvh = job.seconds_bvh;
  baked.report.resident_after_bvh = job.resident_after_bvh;
  baked.report.tiles = run.tiles();
  baked.report.tile = job.plan.edge;
  baked.report.blocks_taken_over = blocks_taken_over;
  baked.report.seconds_total = omp_get_wtime() - start;
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
  MapBlocks blocks(job.rules.coding, make_map_frame(gather_facts(job)).images);
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
