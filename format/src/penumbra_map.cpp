// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/penumbra_map.h"

#include <algorithm>
#include <cassert>

#include "vertex_bits.h"

namespace pdsm {

bool operator==(const View& a, const View& b) {
  return a.world_to_view.rotation == b.world_to_view.rotation &&
         a.world_to_view.translation == b.world_to_view.translation && a.projection == b.projection &&
         a.window == b.window && a.near_depth == b.near_depth && a.far_depth == b.far_depth &&
         a.width == b.width && a.height == b.height;
}

std::array<std::uint32_t, 2> block_extent(std::uint32_t image_width, std::uint32_t image_height,
                                          std::uint32_t bx, std::uint32_t by) {
  assert(std::uint64_t{bx} * kBlockSize < image_width && std::uint64_t{by} * kBlockSize < image_height);
  return {std::min(kBlockSize, image_width - bx * kBlockSize),
          std::min(kBlockSize, image_height - by * kBlockSize)};
}

double decode_depth(const View& view, const VertexCoding& coding, std::uint32_t depth) {
  // The formula below may miss an end by one rounding, so the ends are told apart.
  const std::uint32_t depth_max = coding.depth_max();
  assert(depth <= depth_max);
  if (depth == 0) return view.near_depth;
  if (depth == depth_max) return view.far_depth;
  return (view.near_depth * static_cast<double>(depth_max - depth) +
          view.far_depth * static_cast<double>(depth)) /
         static_cast<double>(depth_max);
}

double depth_step(const View& view, const VertexCoding& coding) {
  return (view.far_depth - view.near_depth) / static_cast<double>(coding.depth_max());
}

void pack_vertex(const VertexCoding& coding, const FunctionVertex& vertex, std::uint32_t* words) {
  assert(vertex.depth <= coding.depth_max());
  assert(vertex.begin <= coding.value_max && vertex.end <= coding.value_max);
  store_vertex(coding, vertex, words);
}

FunctionVertex unpack_vertex(const VertexCoding& coding, const std::uint32_t* words) {
  return load_vertex(coding, words);
}

std::vector<FunctionVertex> unpack_function(const VertexCoding& coding, const FunctionBlock& block,
                                            std::uint32_t texel) {
  assert(std::size_t{texel} + 1 < block.first.size());
  const std::uint32_t first = block.first[texel], last = block.first[texel + 1];
  const std::size_t stride = coding.words_per_vertex();
  std::vector<FunctionVertex> function(last - first);
  for (std::uint32_t n = first; n < last; ++n)
    function[n - first] = load_vertex(coding, block.words.data() + n * stride);
  return function;
}

double evaluate_function(const View& view, const VertexCoding& coding,
                         std::span<const FunctionVertex> function, double z) {
  // The piece that holds z is the last one that begins before z.
  const auto behind = std::partition_point(
      function.begin(), function.end(),
      [&](const FunctionVertex& vertex) { return decode_depth(view, coding, vertex.depth) < z; });
  if (behind == function.begin()) return 0;
  const FunctionVertex& vertex = *(behind - 1);
  const double begin = vertex.begin, end = vertex.end, value_max = coding.value_max;
  if (behind == function.end()) return begin / value_max;

  const double z0 = decode_depth(view, coding, vertex.depth);
  const double z1 = decode_depth(view, coding, behind->depth);
  return (begin + (end - begin) * ((z - z0) / (z1 - z0))) / value_max;
}

}  // namespace pdsm
