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

namespace pdsm {
namespace {

/// The records of finished blocks, by block.
class ShardBlocks {
 public:
  explicit ShardBlocks(const BakeJob& job) : coding_(job.rules.coding), records_(block_count(job.grid)) {}

  void take(const FittedBlock& block, const EncodedBlock& base) {
    append_block(coding_, block, base, records_[block.index]);
  }
  void take(const FittedBlock& block) {
    take(block, encode_block(coding_, block.width, block.height, block.levels.front()));
  }
  [[nodiscard]] const std::vector<std::vector<std::byte>>& records() const { return records_; }

 private:
  VertexCoding coding_;
  std::vector<std::vector<std::byte>> records_;  ///< each is written by one thread
};

DescribedFacts describe_job(const BakeJob& job, const std::string& key, const DescribeBake& describe) {
  DescribedFacts described{gather_facts(job)};
  if (!describe) return described;
  BakedMap baked;
  baked.map = make_map_frame(described.facts);
  baked.fitted = described.facts.fitted;
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

}  // namespace

std::uint64_t bake_shard(const Scene& scene, const Light& light, const BakeOptions& options,
                         const Share& share, const DescribeBake& describe, const std::filesystem::path& path,
                         const BakeCallbacks& callbacks, Checkpoint* checkpoint) {
  const double start = omp_get_wtime();
  if (share.index < 1 || share.index > share.count || share.count > kMostShares)
    throw Error(Failure::usage, "--shard", "must be I/N with 1 <= I <= N <= 65536");
  if (callbacks.progress) callbacks.progress({"bvh", 0, 0});
  const BakeJob job(scene, light, options, share);
  const std::string key = setup_key(job, light, job.options.isa);
  const PartHeader header{identity_of(key), share.index, share.count};
  std::vector<std::byte> front;
  append_part_header(header, front);
  append_record(kBakeRecord, encode_facts(describe_job(job, key, describe)), front);
  ShardBlocks blocks(job);
  const auto inputs = find_block_inputs(job, light);
  TileInput input = job.tile_input();
  input.block_inputs = inputs.get();
  CheckpointLog* log = checkpoint != nullptr ? &checkpoint->log() : nullptr;
  TileRun run(job, input, logged_output(job, callbacks, log, [&](FittedBlock&& block, EncodedBlock&& base) {
                blocks.take(block, base);
              }));
  TileStatistics taken;
  const auto take_whole = [&](FittedBlock&& block) { blocks.take(block); };
  if (log != nullptr) taken = take_over(*log, header, job, input, run, take_whole);
  if (inputs) take_over_previous(job, input, run, take_whole);
  run.run();
  taken.add(run.statistics());
  const auto is_there = [](const auto& record) { return !record.empty(); };
  const EndRecord end{
      static_cast<std::uint64_t>(std::count_if(blocks.records().begin(), blocks.records().end(), is_there)),
      run.tiles(),
      job.resident_after_bvh,
      static_cast<double>(job.options.threads),
      job.seconds_bvh,
      omp_get_wtime() - start};
  return write_shard(path, front, blocks, shard_end(taken, end));
}

}  // namespace pdsm
