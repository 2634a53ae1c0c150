// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "golden_map.h"
#include "pdsm/format/map_file.h"
#include "scratch_folder.h"

namespace pdsm {
namespace {

const std::filesystem::path kRaw = std::filesystem::path(PDSM_GOLDEN_FOLDER) / "version1-raw.pdsm";
const std::filesystem::path kZstd = std::filesystem::path(PDSM_GOLDEN_FOLDER) / "version1-zstd.pdsm";

class Golden : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(Golden, ReadsToKnownValues) {
  const PenumbraMap map = read_map(GetParam());
  ASSERT_EQ(map.views.size(), 1U);
  const View& view = map.views[0];
  EXPECT_EQ(view.world_to_view.rotation, (std::array<double, 9>{1, 0, 0, 0, 0, 1, 0, -1, 0}));
  EXPECT_EQ(view.world_to_view.translation, (std::array<double, 3>{0.5, -2, 12}));
  EXPECT_EQ(view.projection, Projection::perspective);
  EXPECT_EQ(view.window, (std::array<double, 4>{-0.5, -0.25, 0.75, 0.5}));
  EXPECT_EQ(view.near_depth, 2);
  EXPECT_EQ(view.far_depth, 15.107);
  EXPECT_EQ(view.width, 5U);
  EXPECT_EQ(view.height, 3U);
  EXPECT_EQ(map.layers, (std::vector<std::string>{"static", "doors"}));
  EXPECT_EQ(map.layer_rule, LayerRule::clamped_sum);
  EXPECT_EQ(map.coding, (VertexCoding{16, 8, 250}));
  EXPECT_EQ(map.metadata, "{\"light\": \"golden\"}");
  ASSERT_EQ(map.samples.size(), 2U);
  EXPECT_EQ(map.samples[1], (LightSample{{0.75, -0.25, 0}, {-0.25F, 0.375F}, 0.5F}));
}

TEST_P(Golden, FunctionsAreKnown) {
  const PenumbraMap map = read_map(GetParam());
  ASSERT_EQ(map.images.size(), 4U);
  const FunctionImage& image = map.images[0];
  ASSERT_EQ(image.blocks.size(), 1U);
  const FunctionBlock& block = image.blocks[0];
  EXPECT_EQ(block.first,
            (std::vector<std::uint32_t>{0, 0, 1, 3, 6, 10, 10, 11, 13, 16, 20, 20, 21, 23, 26, 30}));
  EXPECT_EQ(block.domain_end[14], 60014U);
  // Texel (3, 2): three vertices.
  EXPECT_EQ(unpack_function(map.coding, block, 13),
            (std::vector<FunctionVertex>{{1221, 20, 45}, {2221, 70, 95}, {3221, 120, 120}}));
  EXPECT_TRUE(unpack_function(map.coding, block, 10).empty());
  // Half way in the second piece: V = (70 + 95) / 2 / 250.
  const double z = 2 + (15.107 - 2) * 2721 / 65535;
  EXPECT_NEAR(evaluate_function(map.views[0], map.coding, unpack_function(map.coding, block, 13), z), 0.33,
              1e-12);
  const FunctionImage& level = map.images[3];
  EXPECT_EQ(level.width, 2U);
  EXPECT_EQ(level.height, 1U);
  EXPECT_EQ(unpack_function(map.coding, level.blocks[0], 1), (std::vector<FunctionVertex>{{1013, 0, 0}}));
  EXPECT_TRUE(level.blocks[0].domain_end.empty());
}

TEST_P(Golden, IsTheMapOfItsMaker) {
  EXPECT_EQ(read_map(GetParam()), testing::golden_map());
}

INSTANTIATE_TEST_SUITE_P(Version1, Golden, ::testing::Values(kRaw, kZstd),
                         [](const auto& instance) { return instance.param == kRaw ? "raw" : "zstd"; });

TEST(GoldenBytes, RawFileIsWrittenToTheSameBytes) {
  const auto bytes = testing::file_content(kRaw);
  EXPECT_EQ(serialize_map(read_map(kRaw), {Compression::none}), bytes);
}

}  // namespace
}  // namespace pdsm
