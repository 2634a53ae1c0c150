// SPDX-License-Identifier: Apache-2.0
#include "part/merge_shards.h"

#include <omp.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>

#include "pdsm/bake/shard.h"
#include "pdsm/format/error.h"
#include "tile/block_key.h"
#include "tile/map_blocks.h"
#include "tile/parallel_failure.h"

namespace pdsm {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& reason) {
  throw Error(Failure::input, where, reason);
}

std::string place_of(const PartHeader& header) {
  return std::to_string(header.share) + "/" + std::to_string(header.shares);
}

/// All belong to the bake of the first.
void check_kin(std::span<const NamedShard> shards) {
  const NamedShard& first = shards.front();
  for (const NamedShard& shard : shards) {
    const PartHeader &header = shard.contents->header, &ours = first.contents->header;
    if (header.shares != ours.shares) {
      refuse(shard.name, "is shard " + place_of(header) + ", where " + first.name + " is " + place_of(ours));
    }
    if (header.identity != ours.identity ||
        !std::equal(shard.contents->facts.begin(), shard.contents->facts.end(), first.contents->facts.begin(),
                    first.contents->facts.end()))
      refuse(shard.name, "is of another bake than " + first.name);
  }
}

/// "3, 5, 6 of 8"; the first few of many.
std::string missing_text(const std::vector<const NamedShard*>& present) {
  constexpr std::size_t kMostNamed = 8;
  std::string text;
  std::size_t missing = 0;
  for (std::size_t n = 0; n < present.size(); ++n) {
    if (present[n] != nullptr || ++missing > kMostNamed) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(n + 1);
  }
  if (missing > kMostNamed) text += " and " + std::to_string(missing - kMostNamed) + " more";
  return text + " of " + std::to_string(present.size());
}

/// Each share once.
void check_complete(std::span<const NamedShard> shards) {
  std::vector<const NamedShard*> present(shards.front().contents->header.shares);
  for (const NamedShard& shard : shards) {
    const PartHeader& header = shard.contents->header;
    const NamedShard*& place = present[header.share - 1];
    if (place != nullptr) refuse(shard.name, "is shard " + place_of(header) + ", as is " + place->name);
    place = &shard;
  }
  if (std::count(present.begin(), present.end(), nullptr) > 0)
    refuse("shards", missing_text(present) + " missing");
}

/// Of level 0 of all views.
std::uint64_t block_count(const PenumbraMap& map) {
  std::uint64_t count = 0;
  for (const FunctionImage& image : map.images)
    if (image.level == 0) count += std::uint64_t{image.blocks_across()} * image.blocks_up();
  return count;
}

/// One view while its blocks come in.
struct ViewMerge {
  ViewMerge(const PartShape& of_view, std::span<const FunctionImage> images)
      : shape(of_view), blocks(of_view.coding, images) {}

  PartShape shape;
  MapBlocks blocks;
};

/// Puts all blocks of all shards into `sink`.
class BlockMerge {
 public:
  BlockMerge(const MapFacts& facts, const PenumbraMap& frame, const ReadLimits& limits)
      : limits_(limits),
        is_there_(block_count(frame)),
        keys_(facts.size() == 1 && facts.front().has_block_keys ? block_count(frame) : 0) {
    std::uint32_t first_block = 0;
    std::span<const FunctionImage> images = frame.images;
    for (const BakeFacts& of_view : facts) {
      const View& view = of_view.fitted.view;
      const auto of_this = images.first(of_view.mip_levels + 1);
      views_.push_back(
          std::make_unique<ViewMerge>(PartShape{of_view.coding, view.width, view.height, of_view.mip_levels,
                                                of_view.receivers != Receivers::all, first_block},
                                      of_this));
      first_block += of_this.front().blocks_across() * of_this.front().blocks_up();
      images = images.subspan(of_this.size());
    }
  }

  void take(const NamedShard& shard, std::uint32_t threads) {
    const auto& payloads = shard.contents->blocks;
    ParallelFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(threads))
    for (std::size_t n = 0; n < payloads.size(); ++n)
      failure.guard([&] { take_block(shard.name, n, payloads[n]); });
    failure.rethrow();
  }
  [[nodiscard]] const BlockCounts& counts() const {
    return counts_;
  }
  [[nodiscard]] std::vector<BlockKey> release_keys() {
    return keys_.release();
  }
  [[nodiscard]] std::vector<std::vector<EncodedBlock>> release() {
    std::vector<std::vector<EncodedBlock>> all;
    for (const auto& view : views_)
      for (auto& blocks : view->blocks.release()) all.push_back(std::move(blocks));
    return all;
  }

 private:
  void take_block(const std::string& name, std::size_t n, std::span<const std::byte> payload) {
    for (const auto& view : views_) {
      auto block = read_block(view->shape, payload, limits_);
      if (!block) continue;
      {
        const std::lock_guard guard(mutex_);
        const std::uint32_t index = view->shape.first_block + block->index;
        if (is_there_[index]) refuse(name, "a block of it is in the shards twice");
        is_there_[index] = true;
        counts_.add(block->counts);
      }
      keys_.take(*block);
      view->blocks.take(std::move(*block));
      return;
    }
    refuse(name, "block " + std::to_string(n) + " of it is damaged");
  }

  ReadLimits limits_;
  std::vector<bool> is_there_;
  BlockKeyList keys_;
  BlockCounts counts_;
  std::mutex mutex_;  ///< of both
  std::vector<std::unique_ptr<ViewMerge>> views_;
};

BakeReport merged_report(const MapFacts& facts, const BlockCounts& counts,
                         std::span<const NamedShard> shards) {
  TileStatistics taken;
  for (const NamedShard& shard : shards) taken.add(shard.contents->taken);
  BakeReport report = make_report(facts, counts, taken);
  for (const NamedShard& shard : shards) {
    const EndRecord& end = shard.contents->end;
    add_seconds(shard.contents->taken, end.threads, report);
    report.seconds_bvh += end.seconds_bvh;
    report.seconds_total += end.seconds_total;
    report.tiles += end.tiles;
    report.resident_after_bvh = std::max(report.resident_after_bvh, end.resident_after_bvh);
  }
  return report;
}

}  // namespace

BakedMap merge_contents(std::span<const NamedShard> shards, std::uint32_t threads, const ReadLimits& limits) {
  if (shards.empty()) refuse("shards", "none is given");
  check_kin(shards);
  check_complete(shards);
  if (threads == 0) threads = static_cast<std::uint32_t>(std::max(1, omp_get_num_procs()));
  DescribedFacts described = read_facts(shards.front().name, *shards.front().contents);
  BakedMap merged;
  merged.map = make_map_frame(described.facts);
  // Before anything of the map's size is allocated, which a hostile file may claim to be any.
  std::uint64_t blocks = 0;
  for (const NamedShard& shard : shards) blocks += shard.contents->blocks.size();
  if (blocks != block_count(merged.map)) refuse("shards", "do not hold as many blocks as the map has");
  merged.fitted = sum_up_views(described.facts);
  merged.map.metadata = std::move(described.description);
  BlockMerge merge(described.facts, merged.map, limits);
  for (const NamedShard& shard : shards) merge.take(shard, threads);
  merged.map.block_keys = merge.release_keys();
  merged.blocks = merge.release();
  merged.report = merged_report(described.facts, merge.counts(), shards);
  return merged;
}

std::string read_shard_description(const std::filesystem::path& path) {
  const ShardFile file(path);
  return read_facts(file.name, file.contents).description;
}

BakedMap merge_shards(std::span<const std::filesystem::path> paths, std::uint32_t threads) {
  std::deque<ShardFile> files;
  std::vector<NamedShard> shards;
  for (const std::filesystem::path& path : paths) files.emplace_back(path);
  for (const ShardFile& file : files) shards.push_back({file.name, &file.contents});
  return merge_contents(shards, threads);
}

}  // namespace pdsm
