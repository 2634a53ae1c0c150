// SPDX-License-Identifier: Apache-2.0
#include "tile/bake_tile.h"

#include <omp.h>

#include <xmmintrin.h>
#include <algorithm>
#include <atomic>

#include "events/event_log.h"
#include "tile/fit_block.h"
#include "tile/parallel_failure.h"
#include "tile/prepare_block.h"
#include "tile/sample_bias.h"
#include "tile/shadow_cells.h"
#include "trace/raster_map.h"
#include "trace/trace_layers.h"
#include "walk/general_walk.h"
#include "walk/ray_packets.h"
#include "walk/shift_walk.h"

namespace pdsm {
namespace {

/// Flush-to-zero and denormals-are-zero: the same arithmetic in every thread, as Embree wants it.
constexpr unsigned kFlushDenormals = 0x8040;

/// What one thread owns while walking.
struct WalkThread {
  SampleMap map;
  LayerMap layers;                   ///< with translucent casters and volumes only
  std::vector<double> volume_steps;  ///< of the sample
  DepthImage image;
  PacketMask mask;
  ShiftWalk shift;
  std::vector<WalkStep> steps;
  std::vector<EventLog> logs;  ///< one a block
  SlopeBiasStatistics slope_bias;
  TileStatistics statistics;
};

std::vector<TileBlock> cut_blocks(const TileInput& input, const TexelRect& tile) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  const std::uint32_t across = blocks_along(input.grid.texels[0]);
  std::vector<TileBlock> blocks;
  for (std::int32_t y = tile.y0; y < tile.y1; y += edge) {
    for (std::int32_t x = tile.x0; x < tile.x1; x += edge) {
      TileBlock block;
      block.rect = {x, y, std::min(x + edge, tile.x1), std::min(y + edge, tile.y1)};
      block.index = static_cast<std::uint32_t>(y / edge) * across + static_cast<std::uint32_t>(x / edge);
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

/// Switches off the rays that nothing can darken, and leaves out packets that hold no others. What only
/// such rays would look at is not traced, so they must not be walked.
void make_packets(const TileInput& input, const ShadowCells& cells, TileBlock& block) {
  block.packets = make_ray_packets(input.grid, block.rect, block.domain_ends);
  const auto width = static_cast<std::uint32_t>(block.rect.x1 - block.rect.x0);
  for (RayPacket& packet : block.packets) {
    for (std::uint32_t lane = 0; lane < RayPacket::kLanes; ++lane) {
      const auto x = block.rect.x0 - cells.tile.x0 + static_cast<std::int32_t>(packet.texel[lane] % width);
      const auto y = block.rect.y0 - cells.tile.y0 + static_cast<std::int32_t>(packet.texel[lane] / width);
      if (!cells.may_darken(x / kCellSize, y / kCellSize)) packet.domain_end[lane] = RayPacket::kUnused;
    }
  }
  std::erase_if(block.packets, [](const RayPacket& packet) {
    return std::all_of(packet.domain_end.begin(), packet.domain_end.end(),
                       [](float end) { return end == RayPacket::kUnused; });
  });
}

/// The same for rays that are walked one by one.
void make_walk_ends(const ShadowCells& cells, TileBlock& block) {
  block.walk_ends = block.domain_ends;
  if (cells.dark.empty()) return;
  std::size_t texel = 0;
  for (std::int32_t y = block.rect.y0; y < block.rect.y1; ++y) {
    for (std::int32_t x = block.rect.x0; x < block.rect.x1; ++x, ++texel) {
      if (!cells.may_darken((x - cells.tile.x0) / kCellSize, (y - cells.tile.y0) / kCellSize))
        block.walk_ends[texel] = RayPacket::kUnused;
    }
  }
}

/// Calls visit(cell's texels) for the cells of a strip that may be darkened.
template <typename Visitor>
void for_each_dark_cell(const TexelRect& strip, const ShadowCells& cells, Visitor&& visit) {
  const std::int32_t first = (strip.y0 - cells.tile.y0) / kCellSize,
                     last = (strip.y1 - 1 - cells.tile.y0) / kCellSize;
  for (std::int32_t y = first; y <= last; ++y) {
    for (std::int32_t x = 0; x < cells.across; ++x) {
      if (cells.may_darken(x, y)) visit(cells.cell_rect(x, y));
    }
  }
}

/// The rows of a tile that strip `n` of `count` covers, whole blocks.
TexelRect cut_strip(const TexelRect& tile, std::uint32_t n, std::uint32_t count) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  const std::int64_t rows = blocks_along(tile.y1 - tile.y0);
  TexelRect strip = tile;
  strip.y0 = tile.y0 + static_cast<std::int32_t>(rows * n / count) * edge;
  strip.y1 = std::min(tile.y1, tile.y0 + static_cast<std::int32_t>(rows * (n + 1) / count) * edge);
  return strip;
}

void trace_translucent(const TileInput& input, std::uint32_t sample, const MapBias& bias,
                       const PacketMask* mask, WalkThread& thread) {
  if (!input.is_translucent()) return;
  const bool has_volumes = !input.volumes.empty();
  if (has_volumes) input.volume_steps.list(sample, thread.volume_steps);
  VolumeLayers volumes(input.volumes, thread.volume_steps,
                       has_volumes ? input.volume_steps.march_offset(sample) : 0);
  thread.statistics.rays +=
      trace_layers(input.scene, volumes, input.grid, input.samples[sample], bias, mask, thread.map,
                   input.rules.transmittance_unit, thread.layers, thread.slope_bias);
}

/// Traces what the rays of a strip look at in the map of a sample out of the plane.
void trace_general_strip(const TileInput& input, std::uint32_t sample_index, const TexelRect& strip,
                         const ShadowCells& cells, WalkThread& thread) {
  const LightSample& sample = input.samples[sample_index];
  const MapBias bias = sample_bias(input.grid, input.walk, input.shift_law, input.bias, sample);
  thread.map.reset(general_footprint(input.grid, sample, strip), input.grid.ratio[0].fine);
  const PacketMask* mask = nullptr;
  if (input.finds_cells) {
    thread.mask.reset(thread.map.rect());
    for_each_dark_cell(strip, cells, [&](const TexelRect& rays) {
      thread.mask.want(general_footprint(input.grid, sample, rays));
    });
    mask = &thread.mask;
  }
  thread.statistics.rays +=
      trace_sample_map(input.scene, input.grid, sample, bias, mask, thread.map, thread.slope_bias);
  trace_translucent(input, sample_index, bias, mask, thread);
}

/// Traces what the rays of a strip look at in the map of one sample: only cells that may be darkened.
void trace_strip(const TileInput& input, std::uint32_t sample_index, const TexelRect& strip,
                 const ShadowCells& cells, WalkThread& thread) {
  if (!input.shift_law) return trace_general_strip(input, sample_index, strip, cells, thread);
  const LightSample& sample = input.samples[sample_index];
  const MapBias bias = sample_bias(input.grid, input.walk, input.shift_law, input.bias, sample);
  const std::uint32_t interleave = input.grid.ratio[0].fine;
  thread.shift.list(input.grid, sample, input.walk);
  thread.map.reset(thread.shift.footprint(strip), interleave);
  thread.mask.reset(thread.map.rect());
  for_each_dark_cell(strip, cells,
                     [&](const TexelRect& rays) { thread.shift.want_packets(rays, thread.mask); });
  thread.statistics.rays +=
      input.casters.empty()
          ? trace_sample_map(input.scene, input.grid, sample, bias, &thread.mask, thread.map,
                             thread.slope_bias)
          : raster_sample_map(input.scene, input.casters, input.grid, sample, bias, cells.idle_casters,
                              thread.mask, thread.image, thread.map, thread.slope_bias);
  trace_translucent(input, sample_index, bias, &thread.mask, thread);
  thread.shift.bind(thread.map);
}

/// Walks all rays of a block through a sample's map: its SampleMap, or LayeredMap.
template <typename Map>
void walk_block(const TileInput& input, const LightSample& sample, const Map& map, const TileBlock& block,
                WalkThread& thread, EventLog& log) {
  if (input.shift_law)
    thread.shift.walk(map, block.packets, log);
  else
    walk_general(input.grid, sample, input.walk, map, block.rect, block.walk_ends, thread.steps, log);
}

/// Walks all rays of a strip through the map of one sample.
void walk_strip(const TileInput& input, const LightSample& sample, const TexelRect& strip,
                const std::vector<TileBlock>& blocks, WalkThread& thread) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const TileBlock& block = blocks[b];
    if (block.rect.y0 < strip.y0 || block.rect.y0 >= strip.y1) continue;
    if (input.is_translucent())
      walk_block(input, sample, LayeredMap{thread.map, thread.layers, input.rules.transmittance_unit}, block,
                 thread, thread.logs[b]);
    else
      walk_block(input, sample, thread.map, block, thread, thread.logs[b]);
  }
}

void process_sample(const TileInput& input, std::uint32_t sample, const TexelRect& strip,
                    const ShadowCells& cells, const std::vector<TileBlock>& blocks, WalkThread& thread) {
  const double start = omp_get_wtime();
  trace_strip(input, sample, strip, cells, thread);
  const double traced = omp_get_wtime();
  walk_strip(input, input.samples[sample], strip, blocks, thread);
  thread.statistics.trace += traced - start;
  thread.statistics.walk += omp_get_wtime() - traced;
}

/// Share of a tile's work that its walks are, for progress.
constexpr double kWalkShare = 0.85;

/// From so many samples, and such a share of all, on it is foreseen whether events will take more room than
/// there is. Samples have about as many each; a tile that would have had room all the same is halved for
/// little.
constexpr double kLeastSeen = 8, kLeastSeenShare = 1.0 / 32;

class TileJob {
 public:
  TileJob(const TileInput& input, const TexelRect& tile, std::uint32_t strips, std::uint64_t event_limit,
          const BlockSink& sink, const TileProgress& progress)
      : input_(input),
        tile_(tile),
        strips_(strips),
        sink_(sink),
        progress_(progress),
        budget_(event_limit),
        blocks_(cut_blocks(input, tile)),
        walkers_(input.threads) {
    for (WalkThread& walker : walkers_) {
      for (std::size_t b = 0; b < blocks_.size(); ++b) walker.logs.emplace_back(&budget_);
    }
  }

  TileOutcome run(TileStatistics& statistics) {
    const double start = omp_get_wtime();
    prepare();
    statistics.prepare += omp_get_wtime() - start;
    if (!input_.nothing_casts) walk();
    for (const WalkThread& walker : walkers_) {
      statistics.add(walker.statistics);
      statistics.slope_bias_sum += walker.slope_bias.sum;
      statistics.slope_bias_max =
          std::max(statistics.slope_bias_max, static_cast<double>(walker.slope_bias.max));
    }
    if (cancelled_) return TileOutcome::cancelled;
    if (budget_.exceeded()) return TileOutcome::events_exceeded;
    fit(statistics);
    statistics.event_bytes = std::max(statistics.event_bytes, budget_.used());
    return cancelled_ ? TileOutcome::cancelled : TileOutcome::done;
  }

 private:
  void prepare() {
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(input_.threads))
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      failure_.guard([&] { prepare_block(input_, blocks_[b]); });
    failure_.rethrow();
    if (input_.nothing_casts) return;
    if (input_.finds_cells) find_cells();
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(input_.threads))
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      failure_.guard([&] {
        if (input_.shift_law)
          make_packets(input_, cells_, blocks_[b]);
        else
          make_walk_ends(cells_, blocks_[b]);
      });
    }
    failure_.rethrow();
  }

  void find_cells() {
    const ShadowCellInput cell_input{
        input_.scene.geometry(), input_.grid,
        input_.light_bounds,     input_.clip_depth,
        input_.depth_rounding,   input_.casters,
        input_.threads,          input_.light_hull ? &*input_.light_hull : nullptr};
    cells_ = find_shadow_cells(cell_input, tile_,
                               [this](std::int32_t i, std::int32_t j) { return domain_end(i, j); });
  }

  [[nodiscard]] float domain_end(std::int32_t i, std::int32_t j) const {
    const auto edge = static_cast<std::int32_t>(kBlockSize);
    const std::int32_t across = blocks_along(tile_.x1 - tile_.x0);
    const TileBlock& block =
        blocks_[static_cast<std::size_t>((j - tile_.y0) / edge * across + (i - tile_.x0) / edge)];
    return block.domain_ends[static_cast<std::size_t>((j - block.rect.y0) * (block.rect.x1 - block.rect.x0) +
                                                      i - block.rect.x0)];
  }

  void walk() {
    const std::size_t tasks = input_.samples.size() * strips_;
    std::atomic<std::size_t> done = 0;
#pragma omp parallel num_threads(static_cast <int>(input_.threads))
    {
      const unsigned control = _mm_getcsr();
      _mm_setcsr(control | kFlushDenormals);
      WalkThread& thread = walkers_[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(dynamic)
      for (std::size_t task = 0; task < tasks; ++task) {
        if (cancelled_ || budget_.exceeded()) continue;
        failure_.guard([&] {
          const TexelRect strip = cut_strip(tile_, static_cast<std::uint32_t>(task % strips_), strips_);
          if (strip.y0 < strip.y1)
            process_sample(input_, static_cast<std::uint32_t>(task / strips_), strip, cells_, blocks_,
                           thread);
        });
        const double share = static_cast<double>(++done) / static_cast<double>(tasks);
        if (will_exceed(share)) budget_.give_up();
        report(kWalkShare * share);
      }
      _mm_setcsr(control);
    }
    failure_.rethrow();
  }

  /// Whether there is too little room if all walks find as many events as this share of them has. The last
  /// page of each log may be empty. A tile of one block can't be halved, and goes on.
  [[nodiscard]] bool will_exceed(double share) const {
    const double samples = share * static_cast<double>(input_.samples.size());
    if (blocks_.size() == 1 || samples < kLeastSeen || share < kLeastSeenShare) return false;
    const auto open_pages = static_cast<double>(blocks_.size() * walkers_.size() * EventLog::kPageBytes);
    const double taken = static_cast<double>(budget_.used()) - open_pages;
    return taken / share > static_cast<double>(budget_.limit());
  }

  void fit(TileStatistics& statistics) {
    std::vector<FitThread> fitters(input_.threads);
    std::atomic<std::size_t> done = 0;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(input_.threads))
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (cancelled_) continue;
      failure_.guard([&] { fit_and_hand_over(b, fitters[static_cast<std::size_t>(omp_get_thread_num())]); });
      report(kWalkShare +
             (1 - kWalkShare) * static_cast<double>(++done) / static_cast<double>(blocks_.size()));
    }
    failure_.rethrow();
    for (const FitThread& thread : fitters) statistics.add(thread.statistics);
  }

  void fit_and_hand_over(std::size_t b, FitThread& thread) {
    std::vector<const EventLog*> logs;
    for (const WalkThread& walker : walkers_) logs.push_back(&walker.logs[b]);
    FittedBlock fitted = fit_block(input_, blocks_[b], logs, thread);
    fitted.counts.undarkened_texels = cells_.undarkened_texels(blocks_[b].rect);
    for (WalkThread& walker : walkers_) walker.logs[b].clear();
    const double start = omp_get_wtime();
    sink_(std::move(fitted));
    thread.statistics.fit += omp_get_wtime() - start;
  }

  void report(double share) {
    if (omp_get_thread_num() == 0 && progress_ && progress_(share)) cancelled_ = true;
  }

  const TileInput& input_;
  const TexelRect tile_;
  const std::uint32_t strips_;
  const BlockSink& sink_;
  const TileProgress& progress_;
  EventBudget budget_;
  std::vector<TileBlock> blocks_;
  ShadowCells cells_;
  std::vector<WalkThread> walkers_;
  std::atomic<bool> cancelled_ = false;
  ParallelFailure failure_;
};

}  // namespace

void TileStatistics::add(const TileStatistics& other) {
  prepare += other.prepare;
  trace += other.trace;
  walk += other.walk;
  accumulate += other.accumulate;
  fit += other.fit;
  rays += other.rays;
  event_bytes = std::max(event_bytes, other.event_bytes);
  slope_bias_sum += other.slope_bias_sum;
  slope_bias_max = std::max(slope_bias_max, other.slope_bias_max);
}

TileOutcome bake_tile(const TileInput& input, const TexelRect& tile, std::uint32_t strips,
                      std::uint64_t event_limit, const BlockSink& sink, const TileProgress& progress,
                      TileStatistics& statistics) {
  return TileJob(input, tile, strips, event_limit, sink, progress).run(statistics);
}

}  // namespace pdsm
