// SPDX-License-Identifier: Apache-2.0
#include "golden_map.h"

namespace pdsm::testing {
namespace {

/// Functions of 5 x 3 texels: empty where x = 0, else x vertices that depend on texel, level and layer.
FunctionBlock golden_block(const VertexCoding& coding, std::uint32_t width, std::uint32_t height,
                           std::uint32_t shift) {
  FunctionBlock block;
  block.first.push_back(0);
  for (std::uint32_t texel = 0; texel < width * height; ++texel) {
    const std::uint32_t x = texel % width, y = texel / width;
    for (std::uint32_t n = 0; n < x; ++n) {
      const std::uint32_t begin = (50 * n + 10 * y) % 201, end = n + 1 < x ? begin + 25 : begin;
      const std::uint32_t depth = 1000 * (n + 1) + 100 * y + 7 * x + shift;
      block.words.push_back(0);
      pack_vertex(coding, {depth, begin, end}, &block.words.back());
    }
    block.first.push_back(static_cast<std::uint32_t>(block.words.size()));
  }
  return block;
}

}  // namespace

PenumbraMap golden_map() {
  PenumbraMap map;
  map.coding = {16, 8, 250};
  map.layers = {"static", "doors"};
  map.layer_rule = LayerRule::clamped_sum;
  View view;
  view.world_to_view = {{1, 0, 0, 0, 0, 1, 0, -1, 0}, {0.5, -2, 12}};
  view.window = {-0.5, -0.25, 0.75, 0.5};
  view.near_depth = 2;
  view.far_depth = 15.107;
  view.width = 5;
  view.height = 3;
  map.views = {view};
  map.samples = {{{-0.75, 0.25, 0}, {0.125F, -0.5F}, 1}, {{0.75, -0.25, 0}, {-0.25F, 0.375F}, 0.5F}};
  map.metadata = R"({"light": "golden"})";
  for (std::uint32_t layer : {0U, 1U}) {
    for (std::uint32_t level : {0U, 1U}) {
      const std::uint32_t width = 5U >> level, height = 3U >> level;
      FunctionImage image{layer, 0, 0, level, width, height, {}};
      image.blocks.push_back(golden_block(map.coding, width, height, 5 * level + layer));
      if (layer == 0 && level == 0)
        for (std::uint32_t texel = 0; texel < 15; ++texel)
          image.blocks[0].domain_end.push_back(60000 + texel);
      map.images.push_back(image);
    }
  }
  return map;
}

}  // namespace pdsm::testing
