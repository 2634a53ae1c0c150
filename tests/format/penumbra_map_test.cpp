// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/penumbra_map.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "random_map.h"

namespace pdsm {
namespace {

using testing::all_codings;

TEST(VertexCoding, WordsPerVertex) {
  const std::array<std::array<std::uint32_t, 3>, 6> expected{
      {{16, 8, 1}, {16, 16, 2}, {16, 32, 3}, {32, 8, 2}, {32, 16, 2}, {32, 32, 3}}};
  for (const auto& [depth_bits, value_bits, words] : expected)
    EXPECT_EQ((VertexCoding{depth_bits, value_bits, 1}.words_per_vertex()), words);
}

TEST(VertexCoding, PackedBitsAreAsSpecified) {
  std::array<std::uint32_t, 3> words{~0U, ~0U, ~0U};
  pack_vertex({16, 8, 255}, {0x1234, 0x56, 0x78}, words.data());
  EXPECT_EQ(words[0], 0x78561234U);
  pack_vertex({16, 16, 0xFFFF}, {0x1234, 0x5678, 0x9ABC}, words.data());
  EXPECT_EQ(words, (std::array<std::uint32_t, 3>{0x56781234, 0x00009ABC, ~0U}));
  pack_vertex({16, 32, ~0U}, {0x1234, 0x56789ABC, 0xDEF01234}, words.data());
  EXPECT_EQ(words, (std::array<std::uint32_t, 3>{0x9ABC1234, 0x12345678, 0x0000DEF0}));
  pack_vertex({32, 8, 255}, {0x12345678, 0x9A, 0xBC}, words.data());
  EXPECT_EQ(words, (std::array<std::uint32_t, 3>{0x12345678, 0x0000BC9A, 0x0000DEF0}));
  pack_vertex({32, 32, ~0U}, {0x12345678, 1, 2}, words.data());
  EXPECT_EQ(words, (std::array<std::uint32_t, 3>{0x12345678, 1, 2}));
}

TEST(VertexCoding, UnpackIsTheInverse) {
  EXPECT_TRUE(rc::check("unpack(pack(v)) = v", [](std::uint64_t seed) {
    testing::Random random(seed);
    for (const VertexCoding& coding : all_codings()) {
      const auto function = testing::random_function(random, coding, 3);
      const FunctionBlock block = testing::make_block(coding, {{}, function, {}});
      RC_ASSERT(unpack_function(coding, block, 0).empty());
      RC_ASSERT(unpack_function(coding, block, 1) == function);
      RC_ASSERT(unpack_vertex(coding, block.words.data()) == function[0]);
    }
  }));
}

TEST(DecodeDepth, BothEndsAreExactAndOrderHolds) {
  EXPECT_TRUE(rc::check("near and far exact, monotone", [](std::uint64_t seed) {
    testing::Random random(seed);
    View view;
    view.near_depth = random.real(1e-3, 10) * std::exp2(random.real(-20, 20));
    view.far_depth = view.near_depth * (1 + random.real(1e-4, 1e4));
    for (std::uint32_t depth_bits : {16U, 32U}) {
      const VertexCoding coding{depth_bits, 8, 255};
      RC_ASSERT(decode_depth(view, coding, 0) == view.near_depth);
      RC_ASSERT(decode_depth(view, coding, coding.depth_max()) == view.far_depth);
      const auto code = static_cast<std::uint32_t>(random.below(coding.depth_max()));
      for (std::uint32_t d : {0U, code, coding.depth_max() - 1})
        RC_ASSERT(decode_depth(view, coding, d) < decode_depth(view, coding, d + 1));
      const double expected = view.near_depth + code * depth_step(view, coding);
      RC_ASSERT(std::abs(decode_depth(view, coding, code) - expected) <= 1e-15 * 4 * view.far_depth);
    }
  }));
}

/// Depths x for which x * depth_max / depth_max is not x in double.
TEST(DecodeDepth, EndsAreExactWhereTheFormulaRounds) {
  const std::array<std::pair<std::uint32_t, double>, 2> cases{{{16, 0x1.a45018cd88p+0}, {32, 0x1.316c08p+0}}};
  for (const auto& [depth_bits, depth] : cases) {
    const VertexCoding coding{depth_bits, 8, 255};
    View view;
    view.near_depth = depth;
    view.far_depth = 16 * depth;
    EXPECT_EQ(decode_depth(view, coding, 0), depth);
    EXPECT_EQ(decode_depth(view, coding, coding.depth_max()), 16 * depth);
  }
}

TEST(BlockExtent, CutsAtTheUpperBorders) {
  using Extent = std::array<std::uint32_t, 2>;
  EXPECT_EQ(block_extent(64, 64, 0, 0), (Extent{64, 64}));
  EXPECT_EQ(block_extent(65, 130, 0, 0), (Extent{64, 64}));
  EXPECT_EQ(block_extent(65, 130, 1, 2), (Extent{1, 2}));
  EXPECT_EQ(block_extent(7, 13, 0, 0), (Extent{7, 13}));
}

/// near 1, far 65536: code d is depth 1 + d.
View unit_view() {
  View view;
  view.near_depth = 1;
  view.far_depth = 65536;
  view.width = view.height = 1;
  return view;
}

TEST(EvaluateFunction, IsLeftContinuousWithExactJumps) {
  const View view = unit_view();
  const VertexCoding coding{16, 8, 100};
  // 0 up to 11, jumps to 0.2, rises to 0.4 at 21, jumps to 1, falls to 0.5 at 31 and stays.
  const std::vector<FunctionVertex> function{{10, 20, 40}, {20, 100, 50}, {30, 50, 50}};
  const auto at = [&](double z) { return evaluate_function(view, coding, function, z); };
  EXPECT_EQ(at(0), 0);
  EXPECT_EQ(at(11), 0);
  EXPECT_NEAR(at(std::nextafter(11, 12)), 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(at(16), 0.3);
  EXPECT_DOUBLE_EQ(at(21), 0.4);
  EXPECT_NEAR(at(std::nextafter(21, 22)), 1, 1e-12);
  EXPECT_DOUBLE_EQ(at(26), 0.75);
  EXPECT_DOUBLE_EQ(at(31), 0.5);
  EXPECT_DOUBLE_EQ(at(1e9), 0.5);
}

TEST(EvaluateFunction, WithoutVerticesIsZero) {
  EXPECT_EQ(evaluate_function(unit_view(), {}, {}, 5), 0);
  EXPECT_EQ(evaluate_function(unit_view(), {}, {}, 1e9), 0);
}

TEST(EvaluateFunction, EndsOfTheRange) {
  const View view = unit_view();
  const std::vector<FunctionVertex> function{{0, 255, 255}, {65535, 51, 51}};
  const auto at = [&](double z) { return evaluate_function(view, {}, function, z); };
  EXPECT_EQ(at(1), 0);
  EXPECT_EQ(at(std::nextafter(1, 2)), 1);
  EXPECT_EQ(at(65536), 1);
  EXPECT_EQ(at(65537), 0.2);
}

TEST(View, EqualityLooksAtEverything) {
  const View view = testing::random_map(1).views[0];
  EXPECT_EQ(view, view);
  const auto differs = [&](auto change) {
    View other = view;
    change(other);
    EXPECT_FALSE(other == view);
  };
  for (std::size_t n = 0; n < 9; ++n) differs([n](View& v) { v.world_to_view.rotation[n] += 1; });
  for (std::size_t n = 0; n < 3; ++n) differs([n](View& v) { v.world_to_view.translation[n] += 1; });
  for (std::size_t n = 0; n < 4; ++n) differs([n](View& v) { v.window[n] += 1; });
  differs([](View& v) { v.projection = Projection::orthographic; });
  differs([](View& v) { v.near_depth += 1; });
  differs([](View& v) { v.far_depth += 1; });
  differs([](View& v) { ++v.width; });
  differs([](View& v) { ++v.height; });
}

}  // namespace
}  // namespace pdsm
