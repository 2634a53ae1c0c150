// SPDX-License-Identifier: Apache-2.0
#include "support/baked_functions.h"

namespace pdsm::test {

BakedFunctions::BakedFunctions(const Scene& scene, const Light& light, const BakeOptions& options)
    : baked_(bake(scene, light, options)), map_(decode_blocks(baked_)) {}

BakedFunctions::Place BakedFunctions::place(std::uint32_t i, std::uint32_t j, std::size_t index) const {
  const FunctionImage& image = map_.images[index];
  const std::uint32_t bx = i / kBlockSize, by = j / kBlockSize;
  const std::uint32_t width = block_extent(image.width, image.height, bx, by)[0];
  return {&image.blocks[std::size_t{by} * image.blocks_across() + bx],
          j % kBlockSize * width + i % kBlockSize};
}

std::vector<FunctionVertex> BakedFunctions::function(std::uint32_t i, std::uint32_t j,
                                                     std::uint32_t level) const {
  const Place p = place(i, j, level);
  return unpack_function(map_.coding, *p.block, p.texel);
}

double BakedFunctions::value(std::uint32_t i, std::uint32_t j, double z, std::uint32_t channel) const {
  return evaluate_function(view(), map_.coding, function(i, j, channel), z);
}

double BakedFunctions::domain_end(std::uint32_t i, std::uint32_t j) const {
  const std::optional<std::uint32_t> code = end_code(i, j);
  return code ? decode_depth(view(), map_.coding, *code) : view().far_depth;
}

std::optional<std::uint32_t> BakedFunctions::end_code(std::uint32_t i, std::uint32_t j,
                                                      std::uint32_t level) const {
  const Place p = place(i, j, level);
  if (p.block->domain_end.empty()) return std::nullopt;
  return p.block->domain_end[p.texel];
}

double BakedFunctions::slope_x(std::uint32_t i) const {
  const auto& w = view().window;
  return w[0] + (w[2] - w[0]) * (i + 0.5) / view().width;
}

double BakedFunctions::slope_y(std::uint32_t j) const {
  const auto& w = view().window;
  return w[1] + (w[3] - w[1]) * (j + 0.5) / view().height;
}

double BakedFunctions::map_pitch_x() const {
  return (view().window[2] - view().window[0]) / report().map_width;
}
double BakedFunctions::map_pitch_y() const {
  return (view().window[3] - view().window[1]) / report().map_height;
}

std::uint64_t BakedFunctions::vertex_count() const {
  std::uint64_t total = 0;
  for (const FunctionBlock& block : map_.images[0].blocks) total += block.first.back();
  return total;
}

BakeOptions small_options(std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
  BakeOptions options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  options.threads = 1;
  return options;
}

}  // namespace pdsm::test
