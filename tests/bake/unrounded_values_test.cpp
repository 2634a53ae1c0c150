// SPDX-License-Identifier: Apache-2.0
// Values written unrounded: the same pieces, whose ends rounding takes to those of the map.
#include <gtest/gtest.h>

#include "support/baked_functions.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

/// Scaled values a code holds, as fit_rules.h has it.
constexpr std::int64_t kScale = 256;

Scene plates() {
  Scene scene;
  add(scene, Plate{-1.4, -1.1, 0.3, 0.2, 3});
  add(scene, Plate{-0.2, -0.4, 1.2, 1.3, 4.2});
  add(scene, Plate{-9, -9, 9, 9, 7});
  return scene;
}

PenumbraMap bake_plates(double epsilon, bool unrounded, Receivers receivers) {
  Light light = rect_light(1.5, 1);
  set_view(light, 0.5, 0.4, 2.5, 8);
  BakeOptions options = small_options(40, 30, 200);
  options.epsilon = epsilon;
  options.receivers = receivers;
  options.mip_levels = 2;
  options.unrounded_values = unrounded;
  return decode_blocks(bake(plates(), light, options));
}

/// All vertices of an image of one block.
std::vector<FunctionVertex> vertices_of(const PenumbraMap& map, std::size_t image) {
  const FunctionBlock& block = map.images[image].blocks.front();
  std::vector<FunctionVertex> vertices;
  for (std::uint32_t t = 0; t + 1 < block.first.size(); ++t) {
    const auto function = unpack_function(map.coding, block, t);
    vertices.insert(vertices.end(), function.begin(), function.end());
  }
  return vertices;
}

std::int64_t distance(std::uint32_t fine, std::uint32_t coarse) {
  return std::abs(std::int64_t{fine} - kScale * std::int64_t{coarse});
}

class UnroundedValues : public ::testing::TestWithParam<double> {};

TEST_P(UnroundedValues, AreTheSamePieces) {
  for (const Receivers receivers : {Receivers::volume, Receivers::surfaces}) {
    const PenumbraMap coarse = bake_plates(GetParam(), false, receivers);
    const PenumbraMap fine = bake_plates(GetParam(), true, receivers);
    EXPECT_EQ(fine.coding.value_max, kScale * coarse.coding.value_max);
    EXPECT_EQ(fine.coding.depth_bits, coarse.coding.depth_bits);
    for (std::size_t image = 0; image < coarse.images.size(); ++image) {
      EXPECT_EQ(fine.images[image].blocks[0].first, coarse.images[image].blocks[0].first);
      const auto a = vertices_of(coarse, image), b = vertices_of(fine, image);
      ASSERT_GT(a.size(), 100U >> (2 * image));
      std::size_t off = 0;
      for (std::size_t n = 0; n < a.size(); ++n) {
        ASSERT_EQ(a[n].depth, b[n].depth);
        // Lines are rounded to the nearest code; constants to one within the tube, less than a code away.
        const std::int64_t most = a[n].begin == a[n].end ? kScale - 1 : kScale / 2;
        ASSERT_LE(distance(b[n].begin, a[n].begin), most);
        ASSERT_LE(distance(b[n].end, a[n].end), most);
        off += distance(b[n].begin, a[n].begin) > 0 ? 1 : 0;
      }
      EXPECT_GT(off, a.size() / 2);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Epsilons, UnroundedValues, ::testing::Values(0.05, 0.02, 0.004));

TEST(UnroundedValues, CountsAreWholeAlready) {
  EXPECT_EQ(bake_plates(0, true, Receivers::volume), bake_plates(0, false, Receivers::volume));
}

}  // namespace
}  // namespace pdsm::test
