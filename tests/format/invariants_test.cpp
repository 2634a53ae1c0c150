// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "pdsm/format/map_file.h"
#include "random_map.h"

namespace pdsm {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Two views, two layers, three levels; each function has vertices.
PenumbraMap valid_map() {
  testing::MapShape shape;
  shape.width = 66;
  shape.views = 2;
  shape.layers = 2;
  shape.levels = 3;
  shape.empty_share = 0;
  return testing::random_map(31, shape);
}

/// The fault of a valid map after `change` names `part`.
void expect_fault(const std::string& part, const std::function<void(PenumbraMap&)>& change) {
  PenumbraMap map = valid_map();
  ASSERT_EQ(find_invariant_fault(map), "");
  change(map);
  const std::string fault = find_invariant_fault(map);
  EXPECT_EQ(fault.substr(0, part.size()), part) << fault;
}

TEST(Invariants, Coding) {
  expect_fault("coding", [](PenumbraMap& map) { map.coding.depth_bits = 24; });
  expect_fault("coding", [](PenumbraMap& map) { map.coding.value_bits = 64; });
  expect_fault("channels", [](PenumbraMap& map) { map.channels = 2; });
  expect_fault("coding", [](PenumbraMap& map) { map.coding.value_max = 0; });
  expect_fault("coding", [](PenumbraMap& map) { map.coding.value_max = 256; });
}

TEST(Invariants, ViewNumbers) {
  expect_fault("views:", [](PenumbraMap& map) { map.views.clear(); });
  for (double wrong : {kNan, kInfinity, -kInfinity}) {
    expect_fault("views[1]", [&](PenumbraMap& map) { map.views[1].near_depth = wrong; });
    expect_fault("views[1]", [&](PenumbraMap& map) { map.views[1].far_depth = wrong; });
    for (std::size_t n = 0; n < 4; ++n)
      expect_fault("views[1]", [&](PenumbraMap& map) { map.views[1].window[n] = wrong; });
    for (std::size_t n = 0; n < 9; ++n)
      expect_fault("views[0]", [&](PenumbraMap& map) { map.views[0].world_to_view.rotation[n] = wrong; });
    for (std::size_t n = 0; n < 3; ++n)
      expect_fault("views[0]", [&](PenumbraMap& map) { map.views[0].world_to_view.translation[n] = wrong; });
  }
}

TEST(Invariants, NearAndFar) {
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].far_depth = map.views[0].near_depth; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].near_depth = 0; });
  expect_fault("views[0]",
               [](PenumbraMap& map) { std::swap(map.views[0].near_depth, map.views[0].far_depth); });
  // So close that neighbouring codes would mean the same depth.
  expect_fault("views[0]", [](PenumbraMap& map) {
    map.views[0].near_depth = 1;
    map.views[0].far_depth = 1 + 0x1p-33;
  });
  PenumbraMap map = valid_map();
  map.views[0].near_depth = 1;
  map.views[0].far_depth = 1 + 0x1p-31;
  EXPECT_EQ(find_invariant_fault(map), "");
  map.views[0].projection = Projection::orthographic;
  map.views[0].near_depth = -4;
  EXPECT_EQ(find_invariant_fault(map), "");
  // 65535 or 2^32 - 1 codes are a finite number a metre over 2^-980 m, and none over 2^-1020 m.
  map.views[0].near_depth = 0;
  map.views[0].far_depth = 0x1p-980;
  EXPECT_EQ(find_invariant_fault(map), "");
  expect_fault("views[0]", [](PenumbraMap& wrong) {
    wrong.views[0].projection = Projection::orthographic;
    wrong.views[0].near_depth = 0;
    wrong.views[0].far_depth = 0x1p-1020;
  });
}

TEST(Invariants, WindowAndSize) {
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].window = {0, 0, 0, 1}; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].window = {0, 1, 1, 0}; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].window = {-1e308, 0, 1e308, 1}; });
  // Texels so narrow that their number per unit is infinite.
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].window = {0, 0, 0x1p-1073, 1}; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].window = {0, 0, 1, 0x1p-1073}; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].width = 0; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].height = (1U << 20) + 1; });
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].projection = static_cast<Projection>(2); });
}

TEST(Invariants, SingularScalingAndMirroringTransforms) {
  expect_fault("views[0]", [](PenumbraMap& map) { map.views[0].world_to_view.rotation = {}; });
  expect_fault("views[0]", [](PenumbraMap& map) {
    for (double& value : map.views[0].world_to_view.rotation) value *= 1.00001;
  });
  expect_fault("views[0]", [](PenumbraMap& map) {
    for (double& value : map.views[0].world_to_view.rotation) value = -value;
  });
  expect_fault("views[0]", [](PenumbraMap& map) {
    auto& r = map.views[0].world_to_view.rotation;
    for (std::size_t n = 0; n < 3; ++n) r[n] = r[n + 3];
  });
}

TEST(Invariants, Layers) {
  expect_fault("layers", [](PenumbraMap& map) { map.layers.clear(); });
  expect_fault("layers", [](PenumbraMap& map) { map.layers[1] = map.layers[0]; });
  expect_fault("layers", [](PenumbraMap& map) { map.layers[1].clear(); });
  expect_fault("layers", [](PenumbraMap& map) { map.layers[1] = std::string(256, 'x'); });
  expect_fault("layers", [](PenumbraMap& map) { map.layers[1].push_back(static_cast<char>(0xFF)); });
  expect_fault("layers", [](PenumbraMap& map) { map.layer_rule = static_cast<LayerRule>(2); });
}

TEST(Invariants, Images) {
  expect_fault("images:", [](PenumbraMap& map) { map.images.clear(); });
  expect_fault("images:", [](PenumbraMap& map) { map.images.erase(map.images.begin() + 3); });
  expect_fault("images:", [](PenumbraMap& map) { std::swap(map.images[1], map.images[2]); });
  expect_fault("images:", [](PenumbraMap& map) { map.images[1] = map.images[0]; });
  expect_fault("images:", [](PenumbraMap& map) { map.images.back().view = 2; });
  expect_fault("images:", [](PenumbraMap& map) { map.images.back().layer = 2; });
  expect_fault("images:", [](PenumbraMap& map) { map.images[1].width = 66; });
  expect_fault("images:", [](PenumbraMap& map) { map.images[1].height = 5; });
  expect_fault("images:", [](PenumbraMap& map) { map.images[1].channel = 1; });
  expect_fault("images:", [](PenumbraMap& map) { map.channels = 3; });
  // A gap among the levels, of the first view and of the last.
  expect_fault("images:", [](PenumbraMap& map) { map.images.erase(map.images.begin() + 1); });
  expect_fault("images:", [](PenumbraMap& map) { map.images.erase(map.images.end() - 2); });
}

/// Fewer levels of one view than of another are no gap.
TEST(Invariants, ImagesMayHaveFewerLevels) {
  PenumbraMap map = valid_map();
  map.images.erase(map.images.begin() + 2);
  EXPECT_EQ(find_invariant_fault(map), "");
}

TEST(Invariants, Samples) {
  expect_fault("samples[1]", [](PenumbraMap& map) { map.samples[1].weight = -1; });
  expect_fault("samples[1]", [](PenumbraMap& map) { map.samples[1].jitter[1] = 0.5F; });
  expect_fault("samples[1]", [](PenumbraMap& map) { map.samples[1].position[2] = kInfinity; });
}

TEST(Invariants, Metadata) {
  for (const std::string wrong : {"", "{", "[]", "{} ", "{\x80}", "{\xC0\x80}", "{\xE2\x82}"})
    expect_fault("metadata", [&](PenumbraMap& map) { map.metadata = wrong; });
  expect_fault("metadata", [](PenumbraMap& map) { map.metadata = std::string("{\0}", 3); });
}

/// A fault of the second block of image 3.
void expect_block_fault(const std::function<void(const VertexCoding&, FunctionBlock&)>& change) {
  expect_fault("images[3].blocks[1]", [&](PenumbraMap& map) { change(map.coding, map.images[3].blocks[1]); });
}

TEST(Invariants, BlockSizes) {
  expect_fault("images[3].blocks:", [](PenumbraMap& map) { map.images[3].blocks.pop_back(); });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.first.clear(); });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.first.pop_back(); });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.first[0] = 1; });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.first[1] = block.first[2] + 1; });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.words.push_back(0); });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.domain_end.pop_back(); });
  expect_block_fault([](const VertexCoding&, FunctionBlock& block) { block.domain_end[3] = 0x10000; });
}

TEST(Invariants, Vertices) {
  const auto with_function = [](std::vector<FunctionVertex> function) {
    return [function](const VertexCoding& coding, FunctionBlock& block) {
      std::vector<std::vector<FunctionVertex>> functions(block.first.size() - 1);
      functions[5] = function;
      block = testing::make_block(coding, functions);
    };
  };
  expect_block_fault(with_function({{9, 1, 2}, {9, 3, 3}}));
  expect_block_fault(with_function({{9, 1, 2}, {8, 3, 3}}));
  expect_block_fault(with_function({{9, 1, 2}}));
  PenumbraMap map = valid_map();
  with_function({{0, 255, 0}, {1, 0, 0}, {65535, 7, 7}})(map.coding, map.images[3].blocks[1]);
  EXPECT_EQ(find_invariant_fault(map), "");
}

}  // namespace
}  // namespace pdsm
