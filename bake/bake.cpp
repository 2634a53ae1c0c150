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
#include "tile/view_jobs.h"

namespace pdsm {
namespace {

/// Samples of a prediction's trial.
constexpr std::uint32_t kTrialSamples = 4;

/// Puts a map together from its blocks, and their keys where these are asked for.
class MapTaker {
 public:
  /// `images` are the levels of one view, the first of them image `first_image` of the map.
  MapTaker(const BakeFacts& facts, std::span<const FunctionImage> images, std::uint32_t first_image,
           const BakeStream& stream)
      : is_kept_(!stream.take),
        keys_(facts.has_block_keys ? std::size_t{images.front().blocks_across()} * images.front().blocks_up()
                                   : 0),
        blocks_(facts.coding, images, from_image(first_image, stream)) {}

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
    // Maps of several views have no keys.
    baked.map.block_keys = keys_.release();
    if (!is_kept_) return;
    for (auto& blocks : blocks_.release()) baked.blocks.push_back(std::move(blocks));
  }

 private:
  static MapBlocks::Finished from_image(std::uint32_t first_image, const BakeStream& stream) {
    if (!stream.take) return {};
    return [first_image, &stream](std::uint32_t level, std::uint32_t block, EncodedBlock&& encoded) {
      stream.take(first_image + level, block, std::move(encoded));
    };
  }

  bool is_kept_;
  BlockKeyList keys_;
  MapBlocks blocks_;
};

/// Bakes the views of a map, one after the other.
class ViewBakes {
 public:
  ViewBakes(const ViewJobs& jobs, const Light& light, const MapFacts& facts, const BakeStream& stream,
            const BakeCallbacks& callbacks, CheckpointLog* log)
      : jobs_(jobs),
        light_(light),
        facts_(facts),
        stream_(stream),
        callbacks_(callbacks),
        log_(log),
        firsts_(first_blocks(jobs)) {}

  void run(const std::string& key, BakedMap& baked) {
    std::vector<PartRecord> records;
    if (log_ != nullptr) records = log_->begin({identity_of(key)});
    taken_ = taken_by(records);
    for (std::size_t view = 0; view < jobs_.size(); ++view) run_view(view, records, baked);
    if (log_ != nullptr) log_->release_records();
  }
  [[nodiscard]] const TileStatistics& taken() const { return taken_; }
  [[nodiscard]] const BlockCounts& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t tiles() const { return tiles_; }
  [[nodiscard]] std::uint64_t blocks_taken_over() const { return blocks_taken_over_; }

 private:
  void run_view(std::size_t view, std::span<const PartRecord> records, BakedMap& baked) {
    const BakeJob& job = *jobs_[view];
    const auto inputs = find_block_inputs(job, light_);
    TileInput input = job.tile_input();
    input.block_inputs = inputs.get();
    const std::size_t levels = job.mip_levels + 1;
    MapTaker taker(facts_[view], std::span(baked.map.images).subspan(view * levels, levels),
                   static_cast<std::uint32_t>(view * levels), stream_);
    TileRun run(job, input,
                logged_output(job, view_callbacks(callbacks_, view, jobs_.size()), log_, firsts_[view],
                              [&](FittedBlock&& block, EncodedBlock&& base) {
                                taker.take(std::move(block), std::move(base));
                              }));
    const auto take_whole = [&taker](FittedBlock&& block) { taker.take(std::move(block)); };
    take_over(records, job, firsts_[view], input, run, take_whole);
    if (inputs != nullptr) blocks_taken_over_ += take_over_previous(job, input, run, take_whole);
    run.run();
    taken_.add(run.statistics());
    counts_.add(run.counts());
    tiles_ += run.tiles();
    taker.release(baked);
  }

  const ViewJobs& jobs_;
  const Light& light_;
  const MapFacts& facts_;
  const BakeStream& stream_;
  const BakeCallbacks& callbacks_;
  CheckpointLog* log_;
  std::vector<std::uint32_t> firsts_;
  TileStatistics taken_;
  BlockCounts counts_;
  std::uint64_t tiles_ = 0, blocks_taken_over_ = 0;
};

BakePrediction predict_view(const BakeJob& job) {
  const auto count = static_cast<std::uint32_t>(job.samples.size());
  const std::uint32_t stride = std::max(1u, count / kTrialSamples);
  const TileInput trial = job.tile_input(stride);
  const double scale = static_cast<double>(count) / static_cast<double>(trial.samples.size());
  // The trial's blocks are encoded as a bake's are, then dropped.
  MapBlocks blocks(job.rules.coding, make_map_frame({gather_facts(job)}).images);
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

}  // namespace

BakedMap bake(const Scene& scene, const Light& light, const BakeOptions& options,
              const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  return bake_streamed(scene, light, options, {}, callbacks, checkpoint);
}

BakedMap bake_streamed(const Scene& scene, const Light& light, const BakeOptions& options,
                       const BakeStream& stream, const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  const double start = omp_get_wtime();
  if (callbacks.progress) callbacks.progress({"bvh", 0, 0});
  const ViewJobs jobs = make_views<BakeJob>(scene, light, options, Share{});
  const BakeOptions& resolved = jobs.front()->options;
  const MapFacts facts = gather_facts(jobs);
  const std::string key = views_key(jobs, light, resolved.isa);
  BakedMap baked;
  baked.map = make_map_frame(facts);
  baked.fitted = sum_up_views(facts);
  if (stream.begin) {
    baked.report = make_report(facts, {}, {});
    baked.report.key = key;
    stream.begin(baked);
  }
  ViewBakes views(jobs, light, facts, stream, callbacks,
                  checkpoint != nullptr ? &checkpoint->log() : nullptr);
  views.run(key, baked);
  baked.report = make_report(facts, views.counts(), views.taken());
  baked.report.key = key;
  add_seconds(views.taken(), resolved.threads, baked.report);
  for (const auto& job : jobs) {
    baked.report.seconds_bvh += job->seconds_bvh;
    baked.report.resident_after_bvh = std::max(baked.report.resident_after_bvh, job->resident_after_bvh);
    baked.report.tile = std::max(baked.report.tile, job->plan.edge);
  }
  baked.report.tiles = views.tiles();
  baked.report.blocks_taken_over = views.blocks_taken_over();
  baked.report.seconds_total = omp_get_wtime() - start;
  return baked;
}

void bake_blocks(const BakeJob& job, const BlockSink& sink, const BakeCallbacks& callbacks) {
  const TileInput input = job.tile_input();
  TileRun(job, input, {sink, callbacks}).run();
}

BakePrediction predict_bake(const Scene& scene, const Light& light, const BakeOptions& options) {
  BakePrediction all;
  for (const auto& job : make_views<BakeJob>(scene, light, options, Share{})) {
    const BakePrediction view = predict_view(*job);
    all.rays += view.rays;
    all.events += view.events;
    all.seconds += view.seconds;
    all.memory_bytes = std::max(all.memory_bytes, view.memory_bytes);
    all.scene_bytes = std::max(all.scene_bytes, view.scene_bytes);
    all.tile = std::max(all.tile, view.tile);
    all.tiles += view.tiles;
  }
  return all;
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
