// SPDX-License-Identifier: Apache-2.0
#include "function_starts.h"

#include <algorithm>

#include "function_reader.h"

namespace pdsm {
namespace {

std::uint16_t least(std::uint16_t a, std::uint16_t b) {
  return std::min(a, b);
}

}  // namespace

FunctionStarts::FunctionStarts(const VertexCoding& coding, const FunctionImage& image) : width_(image.width) {
  const std::uint32_t stride = coding.words_per_vertex();
  starts_.reserve(std::size_t{image.width} * image.height);
  for_each_function(image, [&](std::uint32_t, std::uint32_t, std::uint32_t first, std::uint32_t count,
                               const FunctionBlock& block) {
    // A vertex begins with its depth code.
    const std::uint32_t head = count == 0 ? coding.depth_max() : block.words[std::size_t{first} * stride];
    starts_.push_back(static_cast<std::uint16_t>(head >> (coding.depth_bits - 16)));
  });
  // The least of each texel and its neighbour: along rows, then along columns.
  for (auto row = starts_.begin(); row != starts_.end(); row += width_)
    std::transform(row + 1, row + width_, row, row, least);
  std::transform(starts_.begin() + width_, starts_.end(), starts_.begin(), starts_.begin(), least);
}

}  // namespace pdsm
