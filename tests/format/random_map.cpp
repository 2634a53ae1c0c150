// SPDX-License-Identifier: Apache-2.0
#include "random_map.h"

#include <algorithm>
#include <cmath>

namespace pdsm::testing {
namespace {

View random_view(Random& random, const MapShape& shape) {
  View view;
  view.world_to_view = random_motion(random);
  view.projection = shape.projection;
  const double x0 = random.real(-2, 1), y0 = random.real(-2, 1);
  view.window = {x0, y0, x0 + random.real(0.1, 3), y0 + random.real(0.1, 3)};
  view.near_depth = random.real(0.1, 5);
  view.far_depth = view.near_depth + random.real(0.5, 50);
  view.width = shape.width;
  view.height = shape.height;
  return view;
}

FunctionBlock random_block(Random& random, const MapShape& shape, std::uint32_t texel_count) {
  std::vector<std::vector<FunctionVertex>> functions(texel_count);
  for (auto& function : functions) {
    if (random.chance(shape.empty_share)) continue;
    const auto count = static_cast<std::uint32_t>(1 + random.below(shape.most_vertices));
    function = random_function(random, shape.coding, count);
  }
  FunctionBlock block = make_block(shape.coding, functions);
  for (std::uint32_t texel = 0; shape.domain_end && texel < texel_count; ++texel)
    block.domain_end.push_back(
        static_cast<std::uint32_t>(random.below(std::uint64_t{shape.coding.depth_max()} + 1)));
  return block;
}

FunctionImage random_image(Random& random, const MapShape& shape, std::uint32_t level) {
  FunctionImage image;
  image.level = level;
  image.width = std::max(1U, shape.width >> level);
  image.height = std::max(1U, shape.height >> level);
  for (std::uint32_t by = 0; by < image.blocks_up(); ++by) {
    for (std::uint32_t bx = 0; bx < image.blocks_across(); ++bx) {
      const auto extent = block_extent(image.width, image.height, bx, by);
      image.blocks.push_back(random_block(random, shape, extent[0] * extent[1]));
    }
  }
  return image;
}

/// All channels and levels of a layer and view. Some blocks of green and blue are those of red.
void add_images(Random& random, const MapShape& shape, std::uint32_t layer, std::uint32_t view,
                std::vector<FunctionImage>& images) {
  const std::size_t red = images.size();
  for (std::uint32_t channel = 0; channel < shape.channels; ++channel) {
    for (std::uint32_t level = 0; level < shape.levels; ++level) {
      FunctionImage image = random_image(random, shape, level);
      image.layer = layer;
      image.view = view;
      image.channel = channel;
      for (std::size_t b = 0; b < image.blocks.size(); ++b) {
        if (channel > 0 && random.chance(0.5)) image.blocks[b] = images[red + level].blocks[b];
      }
      images.push_back(std::move(image));
    }
  }
}

}  // namespace

std::vector<FunctionVertex> random_function(Random& random, const VertexCoding& coding,
                                            std::uint32_t vertex_count) {
  std::vector<std::uint32_t> depths;
  while (depths.size() < vertex_count) {
    depths.push_back(static_cast<std::uint32_t>(random.below(std::uint64_t{coding.depth_max()} + 1)));
    // Runs of neighbouring codes, too.
    if (random.chance(0.2) && depths.back() < coding.depth_max()) depths.push_back(depths.back() + 1);
    std::sort(depths.begin(), depths.end());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  }
  depths.resize(vertex_count);
  std::vector<FunctionVertex> function;
  const auto value = [&] {
    if (random.chance(0.1)) return coding.value_max;
    return static_cast<std::uint32_t>(random.below(std::uint64_t{coding.value_max} + 1));
  };
  for (std::uint32_t depth : depths) function.push_back({depth, value(), value()});
  if (!function.empty()) function.back().end = function.back().begin;
  return function;
}

RigidTransform random_motion(Random& random) {
  // Euler angles: rows are Rz Ry Rx multiplied out.
  const double a = random.real(-3.2, 3.2), b = random.real(-3.2, 3.2), c = random.real(-3.2, 3.2);
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b), cc = std::cos(c),
               sc = std::sin(c);
  RigidTransform motion;
  motion.rotation = {ca * cb,
                     ca * sb * sc - sa * cc,
                     ca * sb * cc + sa * sc,
                     sa * cb,
                     sa * sb * sc + ca * cc,
                     sa * sb * cc - ca * sc,
                     -sb,
                     cb * sc,
                     cb * cc};
  motion.translation = {random.real(-9, 9), random.real(-9, 9), random.real(-9, 9)};
  return motion;
}

FunctionBlock make_block(const VertexCoding& coding,
                         const std::vector<std::vector<FunctionVertex>>& functions) {
  FunctionBlock block;
  block.first.push_back(0);
  const std::size_t stride = coding.words_per_vertex();
  for (const auto& function : functions) {
    for (const FunctionVertex& vertex : function) {
      block.words.resize(block.words.size() + stride);
      pack_vertex(coding, vertex, &block.words[block.words.size() - stride]);
    }
    block.first.push_back(static_cast<std::uint32_t>(block.words.size() / stride));
  }
  return block;
}

PenumbraMap random_map(std::uint64_t seed, const MapShape& shape) {
  Random random(seed);
  PenumbraMap map;
  map.coding = shape.coding;
  map.layers.clear();
  for (std::uint32_t n = 0; n < shape.layers; ++n) map.layers.push_back("layer " + std::to_string(n));
  map.layer_rule = random.chance(0.5) ? LayerRule::maximum : LayerRule::clamped_sum;
  for (std::uint32_t n = 0; n < shape.views; ++n) map.views.push_back(random_view(random, shape));
  for (std::uint32_t n = 0; n < shape.samples; ++n) {
    map.samples.push_back({{random.real(-1, 1), random.real(-1, 1), 0},
                           {static_cast<float>(random.real(-0.5, 0.49)), -0.5F},
                           static_cast<float>(random.real(0, 2))});
  }
  map.channels = shape.channels;
  for (std::uint32_t layer = 0; layer < shape.layers; ++layer) {
    for (std::uint32_t view = 0; view < shape.views; ++view)
      add_images(random, shape, layer, view, map.images);
  }
  const FunctionImage& base = map.images.front();
  for (std::uint32_t n = shape.block_keys ? base.blocks_across() * base.blocks_up() : 0; n > 0; --n)
    map.block_keys.push_back(
        {{random.below(~std::uint64_t{0}), n}, random.below(~std::uint64_t{0}), n, n % 2});
  map.metadata = "{\"seed\": " + std::to_string(seed) + ", \"name\": \"caf\u00e9\"}";
  return map;
}

PenumbraMap channel_of(const PenumbraMap& map, std::uint32_t channel) {
  PenumbraMap one = map;
  one.channels = 1;
  std::erase_if(one.images, [channel](const FunctionImage& image) { return image.channel != channel; });
  for (FunctionImage& image : one.images) image.channel = 0;
  return one;
}

MapShape random_shape(std::uint64_t seed) {
  Random random(seed ^ 0x5eedULL);
  MapShape shape;
  const auto codings = all_codings();
  shape.coding = codings[random.below(codings.size())];
  shape.width = static_cast<std::uint32_t>(1 + random.below(random.chance(0.2) ? 80 : 9));
  shape.height = static_cast<std::uint32_t>(1 + random.below(random.chance(0.2) ? 80 : 9));
  shape.views = static_cast<std::uint32_t>(1 + random.below(3));
  shape.layers = static_cast<std::uint32_t>(1 + random.below(3));
  shape.channels = random.chance(0.3) ? 3 : 1;
  shape.levels = static_cast<std::uint32_t>(1 + random.below(4));
  shape.samples = static_cast<std::uint32_t>(random.below(4));
  shape.most_vertices = static_cast<std::uint32_t>(1 + random.below(20));
  shape.empty_share = random.real(0, 1);
  shape.domain_end = random.chance(0.5);
  shape.block_keys = seed % 3 == 0;
  shape.projection = random.chance(0.5) ? Projection::perspective : Projection::orthographic;
  return shape;
}

std::vector<VertexCoding> all_codings() {
  std::vector<VertexCoding> codings;
  for (std::uint32_t depth_bits : {16U, 32U}) {
    for (std::uint32_t value_bits : {8U, 16U, 32U}) {
      const auto all_ones = static_cast<std::uint32_t>((std::uint64_t{1} << value_bits) - 1);
      codings.push_back({depth_bits, value_bits, all_ones});
      codings.push_back({depth_bits, value_bits, value_bits == 8 ? 64U : 256U});
    }
  }
  codings.push_back({16, 8, 1});
  return codings;
}

std::string name_of(const VertexCoding& coding) {
  return "depth " + std::to_string(coding.depth_bits) + ", value " + std::to_string(coding.value_bits) +
         ", max " + std::to_string(coding.value_max);
}

}  // namespace pdsm::testing
