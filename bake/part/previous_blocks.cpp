// SPDX-License-Identifier: Apache-2.0
#include "part/previous_blocks.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "part/part_records.h"
#include "pdsm/format/block_reader.h"
#include "tile/bake_facts.h"
#include "tile/block_grid.h"
#include "tile/block_key.h"
#include "tile/parallel_failure.h"
#include "tile/prepare_block.h"

namespace pdsm {
namespace {

/// Texels of a block or of a level's part of one.
struct Extent {
  std::uint32_t width = 0, height = 0;
};

/// Texels [x, x + extent.width) x [y, y + extent.height) of `whole`, whose rows are `pitch` texels.
FunctionBlock cut_part(const VertexCoding& coding, const FunctionBlock& whole, std::uint32_t pitch,
                       std::uint32_t x, std::uint32_t y, const Extent& extent) {
  const auto words = static_cast<std::ptrdiff_t>(coding.words_per_vertex());
  FunctionBlock part;
  part.first.push_back(0);
  for (std::uint32_t row = 0; row < extent.height; ++row) {
    const std::uint32_t first = (y + row) * pitch + x, last = first + extent.width;
    part.words.insert(part.words.end(), whole.words.begin() + words * whole.first[first],
                      whole.words.begin() + words * whole.first[last]);
    const std::uint32_t shift = part.first.back() - whole.first[first];
    for (std::uint32_t t = first + 1; t <= last; ++t) part.first.push_back(whole.first[t] + shift);
    if (whole.domain_end.empty()) continue;
    part.domain_end.insert(part.domain_end.end(), whole.domain_end.begin() + first,
                           whole.domain_end.begin() + last);
  }
  return part;
}

/// A map of before, block by block.
class PreviousMap {
 public:
  /// Nothing where the file can't be such a map, or has no keys.
  static std::optional<PreviousMap> open(const BakeJob& job) {
    auto reader = BlockReader::open(job.options.previous);
    if (!reader || reader->frame().block_keys.empty()) return std::nullopt;
    const PenumbraMap &theirs = reader->frame(), ours = make_map_frame({gather_facts(job)});
    if (theirs.coding != ours.coding || theirs.images != ours.images) return std::nullopt;
    return PreviousMap(std::move(*reader));
  }

  [[nodiscard]] const BlockKey& key(std::uint32_t block) const { return map().block_keys[block]; }

  /// Reads what blocks share. Before block().
  void read_levels(std::uint32_t threads) {
    for (std::size_t level = 1; level < map().images.size(); ++level) {
      const FunctionImage& image = map().images[level];
      auto& blocks = levels_.emplace_back(std::size_t{image.blocks_across()} * image.blocks_up());
      ParallelFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(threads))
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        failure.guard([&] {
          blocks[b] = reader_.read(static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(b));
        });
      }
      failure.rethrow();
    }
  }

  /// A block as it was baked; nothing where any of it is damaged, or not what its key was made for.
  [[nodiscard]] std::optional<FittedBlock> block(std::uint32_t index) const {
    FittedBlock block;
    const FunctionImage& base = map().images.front();
    block.index = index;
    const std::uint32_t bx = index % base.blocks_across(), by = index / base.blocks_across();
    const auto extent = block_extent(base.width, base.height, bx, by);
    block.width = extent[0];
    block.height = extent[1];
    auto functions = reader_.read(0, index);
    if (!functions) return std::nullopt;
    block.levels.push_back(std::move(*functions));
    for (std::uint32_t level = 1; level < map().images.size(); ++level) {
      auto part = level_part(level, bx, by, {block.width >> level, block.height >> level});
      if (!part) return std::nullopt;
      block.levels.push_back(std::move(*part));
    }
    block.inputs = key(index).inputs;
    block.counts.events = key(index).events;
    block.counts.undarkened_texels = key(index).undarkened_texels;
    if (block_key(block) != key(index)) return std::nullopt;
    count_functions(block);
    return block;
  }

 private:
  explicit PreviousMap(BlockReader reader) : reader_(std::move(reader)) {}

  [[nodiscard]] const PenumbraMap& map() const {
    return reader_.frame();
  }

  /// What level `level` has of base block (bx, by): nothing of it is there where the block is too narrow.
  [[nodiscard]] std::optional<FunctionBlock> level_part(std::uint32_t level, std::uint32_t bx,
                                                        std::uint32_t by, const Extent& extent) const {
    const FunctionImage& image = map().images[level];
    const std::uint32_t at_x = bx >> level, at_y = by >> level;
    if (extent.width == 0 || extent.height == 0) return FunctionBlock{};
    const auto& whole = levels_[level - 1][std::size_t{at_y} * image.blocks_across() + at_x];
    if (!whole) return std::nullopt;
    const std::uint32_t edge = kBlockSize >> level, inside = (1U << level) - 1;
    const std::uint32_t pitch = block_extent(image.width, image.height, at_x, at_y)[0];
    return cut_part(map().coding, *whole, pitch, (bx & inside) * edge, (by & inside) * edge, extent);
  }

  BlockReader reader_;
  std::vector<std::vector<std::optional<FunctionBlock>>> levels_;  ///< 1, 2, ..., decoded
};

/// The blocks of the plan that are still to be baked.
std::vector<std::uint32_t> open_blocks(const BakeJob& job, const TileRun& run) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  std::vector<std::uint32_t> blocks;
  for (const TexelRect& tile : job.plan.tiles) {
    for (std::int32_t y = tile.y0; y < tile.y1; y += edge) {
      for (std::int32_t x = tile.x0; x < tile.x1; x += edge) {
        const std::uint32_t block = block_at(job.grid, x, y);
        if (!run.is_left_out(block)) blocks.push_back(block);
      }
    }
  }
  return blocks;
}

}  // namespace

std::uint64_t take_over_previous(const BakeJob& job, const TileInput& input, TileRun& run,
                                 const BlockSink& sink) {
  auto previous = PreviousMap::open(job);
  if (!previous) return 0;
  previous->read_levels(job.options.threads);
  const std::vector<std::uint32_t> blocks = open_blocks(job, run);
  std::uint64_t taken = 0;
  std::mutex mutex;
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(job.options.threads))
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    failure.guard([&] {
      if (!previous->key(blocks[n]).is_known()) return;
      TileBlock here;
      here.index = blocks[n];
      here.rect = block_rect(job.grid, here.index);
      prepare_block(input, here);
      if (here.inputs != previous->key(here.index).inputs) return;
      auto block = previous->block(here.index);
      if (!block) return;
      {
        const std::lock_guard guard(mutex);
        run.leave_out(block->index, block->counts);
        ++taken;
      }
      sink(std::move(*block));
    });
  }
  failure.rethrow();
  return taken;
}

}  // namespace pdsm
