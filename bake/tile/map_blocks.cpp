// SPDX-License-Identifier: Apache-2.0
#include "tile/map_blocks.h"

#include <algorithm>
#include <cassert>

namespace pdsm {
namespace {

/// Appends texels [first, last) of `part`.
void append_texels(const VertexCoding& coding, const FunctionBlock& part, std::uint32_t first,
                   std::uint32_t last, FunctionBlock& whole) {
  const auto words = static_cast<std::ptrdiff_t>(coding.words_per_vertex());
  whole.words.insert(whole.words.end(), part.words.begin() + words * part.first[first],
                     part.words.begin() + words * part.first[last]);
  const std::uint32_t shift = whole.first.back() - part.first[first];
  for (std::uint32_t t = first + 1; t <= last; ++t) whole.first.push_back(part.first[t] + shift);
  if (part.domain_end.empty()) return;
  whole.domain_end.insert(whole.domain_end.end(), part.domain_end.begin() + first,
                          part.domain_end.begin() + last);
}

/// One block, width x height texels, of parts of `edge` x `edge` texels, `across` in a row; the last of a
/// row or column are cut.
FunctionBlock join_parts(const VertexCoding& coding, std::span<const FunctionBlock> parts,
                         std::uint32_t across, std::uint32_t edge, std::uint32_t width,
                         std::uint32_t height) {
  FunctionBlock whole;
  whole.first.push_back(0);
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t x = 0; x < width; x += edge) {
      const std::uint32_t part_width = std::min(edge, width - x), row = j % edge * part_width;
      append_texels(coding, parts[j / edge * across + x / edge], row, row + part_width, whole);
    }
  }
  return whole;
}

/// Edge of the part of level `level` that one block of level 0 holds.
std::uint32_t part_edge(std::uint32_t level) {
  return kBlockSize >> level;
}

}  // namespace

MapBlocks::MapBlocks(const VertexCoding& coding, std::span<const FunctionImage> images, Finished finished)
    : coding_(coding), finished_(std::move(finished)) {
  for (const FunctionImage& image : images) {
    assert(image.level == levels_.size());
    open_level(image);
  }
}

void MapBlocks::open_level(const FunctionImage& image) {
  Level& level = levels_.emplace_back(Level{image.width, image.height, image.blocks_across(), {}});
  encoded_.emplace_back(std::size_t{image.blocks_across()} * image.blocks_up());
  const std::uint32_t edge = part_edge(image.level);
  const auto parts_along = [edge](std::uint32_t texels) { return (texels + edge - 1) / edge; };
  for (std::uint32_t b = 0; b < encoded_.back().size(); ++b) {
    const auto [width, height] = block_extent(image.width, image.height, b % level.across, b / level.across);
    OpenBlock& block = level.open.emplace_back();
    block.parts_across = parts_along(width);
    block.missing = parts_along(width) * parts_along(height);
    block.parts.resize(block.missing);
  }
}

void MapBlocks::take(FittedBlock&& block) {
  EncodedBlock base = encode_block(coding_, block.width, block.height, block.levels.front());
  take(std::move(block), std::move(base));
}

void MapBlocks::take(FittedBlock&& block, EncodedBlock&& base) {
  assert(block.levels.size() == levels_.size());
  finish(0, block.index, std::move(base));
  const std::uint32_t bx = block.index % levels_[0].across, by = block.index / levels_[0].across;
  for (std::uint32_t l = 1; l < levels_.size(); ++l) {
    // A narrow block at the border has no texel of the upper levels.
    if (block.width >> l > 0 && block.height >> l > 0) take_level_part(l, bx, by, std::move(block.levels[l]));
  }
}

void MapBlocks::take_level_part(std::uint32_t level, std::uint32_t bx, std::uint32_t by,
                                FunctionBlock&& part) {
  Level& image = levels_[level];
  const std::uint32_t index = (by >> level) * image.across + (bx >> level);
  OpenBlock& open = image.open[index];
  const std::uint32_t inside = (1U << level) - 1;
  {
    const std::lock_guard lock(mutex_);
    open.parts[(by & inside) * open.parts_across + (bx & inside)] = std::move(part);
    if (--open.missing > 0) return;
  }
  const std::vector<FunctionBlock> parts = std::move(open.parts);
  const auto [width, height] =
      block_extent(image.width, image.height, index % image.across, index / image.across);
  // Named anew: clang 14 can't capture structured bindings.
  const auto encode = [&, across = width, up = height](const FunctionBlock& whole) {
    return encode_block(coding_, across, up, whole);
  };
  finish(level, index,
         parts.size() == 1
             ? encode(parts.front())
             : encode(join_parts(coding_, parts, open.parts_across, part_edge(level), width, height)));
}

void MapBlocks::finish(std::uint32_t level, std::uint32_t block, EncodedBlock&& encoded) {
  if (finished_)
    finished_(level, block, std::move(encoded));
  else
    encoded_[level][block] = std::move(encoded);
}

}  // namespace pdsm
