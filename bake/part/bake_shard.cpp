// SPDX-License-Identifier: Apache-2.0
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "invariants.h"
#include "part/checkpoint_log.h"
#include "part/facts_record.h"
#include "part/logged_blocks.h"
#include "part/part_layout.h"
#include "part/previous_blocks.h"
#include "pdsm/bake/shard.h"
#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"
#include "tile/block_grid.h"
#include "tile/block_inputs.h"
#include "tile/setup_key.h"
#include "tile/view_jobs.h"

namespace pdsm {
namespace {

/// The records of finished blocks, by block.
class ShardBlocks {
 public:
  explicit ShardBlocks(const ViewJobs& jobs)
      : coding_(jobs.front()->rules.coding), records_(first_blocks(jobs).back()) {}

  /// `first`: the first block of its view.
  void take(const FittedBlock& block, const EncodedBlock& base, std::uint32_t first) {
    append_block(coding_, block, base, first, records_[first + block.index]);
  }
  void take(const FittedBlock& block, std::uint32_t first) {
    take(block, encode_block(coding_, block.width, block.height, block.levels.front()), first);
  }
  [[nodiscard]] const std::vector<std::vector<std::byte>>& records() const { return records_; }

 private:
  VertexCoding coding_;
  std::vector<std::vector<std::byte>> records_;  ///< each is written by one thread
};

DescribedFacts describe_jobs(const ViewJobs& jobs, const std::string& key, const DescribeBake& describe) {
  DescribedFacts described{gather_facts(jobs)};
  if (!describe) return described;
  BakedMap baked;
  baked.map = make_map_frame(described.facts);
  baked.fitted = sum_up_views(described.facts);
  baked.report = make_report(described.facts, {}, {});
  baked.report.key = key;
  described.description = describe(baked);
  assert(!check_metadata(described.description));
  return described;
}

std::uint64_t write_shard(const std::filesystem::path& path, std::span<const std::byte> front,
                          const ShardBlocks& blocks, std::span<const std::byte> back) {
  AtomicFile file(path);
  std::uint64_t size = front.size() + back.size();
  file.write(front);
  for (const auto& record : blocks.records()) {
    file.write(record);
    size += record.size();
  }
  file.write(back);
  file.commit();
  return size;
}

/// The records behind the blocks.
std::vector<std::byte> shard_end(const TileStatistics& taken, const EndRecord& end) {
  std::vector<std::byte> bytes;
  append_tile(taken, bytes);
  append_record(kEndRecord, std::as_bytes(std::span(&end, 1)), bytes);
  return bytes;
}

/// Bakes the share of all views, one after the other.
struct ShardRun {
  const ViewJobs& jobs;
  const Light& light;
  const BakeCallbacks& callbacks;
  CheckpointLog* log;
  ShardBlocks blocks;
  TileStatistics taken = {};
  std::uint64_t tiles = 0;

  void run(const PartHeader& header) {
    std::vector<PartRecord> records;
    if (log != nullptr) records = log->begin(header);
    taken = taken_by(records);
    const std::vector<std::uint32_t> firsts = first_blocks(jobs);
    for (std::size_t view = 0; view < jobs.size(); ++view) run_view(view, firsts[view], records);
    if (log != nullptr) log->release_records();
  }

  void run_view(std::size_t view, std::uint32_t first, std::span<const PartRecord> records) {
    const BakeJob& job = *jobs[view];
    const auto inputs = find_block_inputs(job, light);
    TileInput input = job.tile_input();
    input.block_inputs = inputs.get();
    TileRun run(
        job, input,
        logged_output(job, view_callbacks(callbacks, view, jobs.size()), log, first,
                      [&](FittedBlock&& block, EncodedBlock&& base) { blocks.take(block, base, first); }));
    const auto take_whole = [&](FittedBlock&& block) { blocks.take(block, first); };
    take_over(records, job, first, input, run, take_whole);
    if (inputs) take_over_previous(job, input, run, take_whole);
    run.run();
    taken.add(run.statistics());
    tiles += run.tiles();
  }
};

}  // namespace

std::uint64_t bake_shard(const Scene& scene, const Light& light, const BakeOptions& options,
                         const Share& share, const DescribeBake& describe, const std::filesystem::path& path,
                         const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  const double start = omp_get_wtime();
  if (share.index < 1 || share.index > share.count || share.count > kMostShares)
    throw Error(Failure::usage, "--shard", "must be I/N with 1 <= I <= N <= 65536");
  if (callbacks.progress) callbacks.progress({"bvh", 0, 0});
  const ViewJobs jobs = make_views<BakeJob>(scene, light, options, share);
  const BakeOptions& resolved = jobs.front()->options;
  const std::string key = views_key(jobs, light, resolved.isa);
  const PartHeader header{identity_of(key), share.index, share.count};
  std::vector<std::byte> front;
  append_part_header(header, front);
  append_record(kBakeRecord, encode_facts(describe_jobs(jobs, key, describe)), front);
  ShardRun run{jobs, light, callbacks, checkpoint != nullptr ? &checkpoint->log() : nullptr,
               ShardBlocks(jobs)};
  run.run(header);
  const auto& records = run.blocks.records();
  EndRecord end;
  end.blocks = static_cast<std::uint64_t>(
      std::ranges::count_if(records, [](const auto& record) { return !record.empty(); }));
  end.tiles = run.tiles;
  end.threads = static_cast<double>(resolved.threads);
  for (const auto& job : jobs) {
    end.seconds_bvh += job->seconds_bvh;
    end.resident_after_bvh = std::max(end.resident_after_bvh, job->resident_after_bvh);
  }
  end.seconds_total = omp_get_wtime() - start;
  return write_shard(path, front, run.blocks, shard_end(run.taken, end));
}

}  // namespace pdsm
