// SPDX-License-Identifier: Apache-2.0
#include "evaluate/map_diff.h"

#include <gtest/gtest.h>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {
namespace {

/// A map of one texel; depth codes 0 .. 65535 are 1 .. 2 m, value codes 0 .. 100.
PenumbraMap map_of(const std::vector<FunctionVertex>& function) {
  PenumbraMap map;
  map.views.resize(1);
  map.views[0].near_depth = 1;
  map.views[0].far_depth = 2;
  map.views[0].width = map.views[0].height = 1;
  map.coding.value_max = 100;
  FunctionImage image;
  image.width = image.height = 1;
  FunctionBlock block;
  const std::uint32_t words = map.coding.words_per_vertex();
  block.first = {0, static_cast<std::uint32_t>(function.size())};
  block.words.resize(function.size() * words);
  for (std::size_t i = 0; i < function.size(); ++i)
    pack_vertex(map.coding, function[i], &block.words[i * words]);
  image.blocks = {block};
  map.images = {image};
  return map;
}

constexpr std::uint32_t kEnd = 65535, kThird = kEnd / 3;

TEST(MapDiff, SameMapsDoNotDiffer) {
  const PenumbraMap map = map_of({{10, 20, 60}, {500, 30, 30}, {kThird, 100, 100}});
  const MapDifference difference = compare_maps(map, map);
  EXPECT_TRUE(difference.incomparable.empty());
  EXPECT_EQ(difference.max_difference, 0);
  EXPECT_EQ(difference.mean_difference, 0);
  EXPECT_EQ(difference.differing_texels, 0U);
  EXPECT_EQ(difference.texels, 1U);
}

TEST(MapDiff, EmptyFunctionsAreZero) {
  const MapDifference difference = compare_maps(map_of({}), map_of({{kThird, 50, 50}}));
  EXPECT_DOUBLE_EQ(difference.max_difference, 0.5);
  EXPECT_NEAR(difference.mean_difference, 0.5 * 2 / 3, 1e-12);
  EXPECT_EQ(difference.differing_texels, 1U);
  EXPECT_NEAR(difference.worst_depth, 1 + 1.0 / 3, 1e-12);
}

TEST(MapDiff, SeesBothSidesOfAJump) {
  // A ramps from 0 to 0.9 and falls to 0 at a third; B is 0 there. Only just left of the jump is it 0.9.
  const PenumbraMap a = map_of({{0, 0, 90}, {kThird, 0, 0}});
  const MapDifference difference = compare_maps(a, map_of({}));
  EXPECT_DOUBLE_EQ(difference.max_difference, 0.9);
  EXPECT_NEAR(difference.mean_difference, 0.5 * 0.9 / 3, 1e-12);
  EXPECT_EQ(compare_maps(map_of({}), a).max_difference, difference.max_difference);
}

TEST(MapDiff, LooksAtVerticesOfBoth) {
  // A is a ramp 0 .. 0.6 .. ; B jumps in its middle.
  const PenumbraMap a = map_of({{0, 0, 60}, {2 * kThird, 60, 60}}), b = map_of({{kThird, 60, 60}});
  const MapDifference difference = compare_maps(a, b);
  EXPECT_NEAR(difference.max_difference, 0.3, 1e-9);
  // Two triangles of 0.3 by a third.
  EXPECT_NEAR(difference.mean_difference, 2 * 0.5 * 0.3 / 3, 1e-9);
}

TEST(MapDiff, CrossingSignsDoNotCancel) {
  // A falls from 0.8 to 0.2 where B is 0.5: |A - B| is 0.3 at both ends, 0 in the middle.
  const PenumbraMap a = map_of({{0, 80, 20}, {kEnd, 20, 20}}), b = map_of({{0, 50, 50}});
  const MapDifference difference = compare_maps(a, b);
  EXPECT_NEAR(difference.max_difference, 0.3, 1e-12);
  EXPECT_NEAR(difference.mean_difference, 0.15, 1e-12);
}

TEST(MapDiff, DomainsAreCountedApart) {
  PenumbraMap a = map_of({}), b = map_of({});
  b.images[0].blocks[0].domain_end = {1000};
  const MapDifference difference = compare_maps(a, b);
  EXPECT_EQ(difference.max_difference, 0);
  EXPECT_EQ(difference.differing_domains, 1U);
}

TEST(MapDiff, OtherViewsAreNotComparable) {
  const PenumbraMap a = map_of({});
  PenumbraMap b = a;
  b.views[0].window[0] = -2;
  EXPECT_EQ(compare_maps(a, b).incomparable, "windows differ");
  b = a;
  b.views[0].world_to_view.translation[2] = 1;
  EXPECT_EQ(compare_maps(a, b).incomparable, "frames of the views differ");
  b = a;
  b.views[0].width = 2;
  EXPECT_EQ(compare_maps(a, b).incomparable, "sizes differ");
  b = a;
  b.views.push_back(b.views[0]);
  EXPECT_EQ(compare_maps(a, b).incomparable, "numbers of views differ");
}

}  // namespace
}  // namespace pdsm
