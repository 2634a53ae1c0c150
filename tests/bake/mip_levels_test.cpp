// SPDX-License-Identifier: Apache-2.0
// A level's texel is the mean of its children's exact functions, within the tube of every fit.
//
// The oracle is a lossless bake without levels whose delta is half a depth code of 32 bits. Events lie at
// floats; a code of these scenes is a hundredth of the distance of two floats at near. So each function keeps
// all its steps apart, the float next to a vertex is the depth of the event, and V is known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/scenes.h"
#include "support/step_functions.h"
#include "tile/tile_plan.h"

namespace pdsm::test {
namespace {

/// Rounding of V and of its bounds in double, each a few operations on numbers up to 1.
constexpr double kValueSlack = 1e-12;

struct Size {
  std::uint32_t width, height;
};
/// The last row or column of each but the first is left over at some level.
constexpr Size kSizes[] = {{128, 64}, {7, 13}, {70, 130}, {65, 66}, {1, 1}, {1, 9}, {90, 1}};

Scene plates_and_sphere() {
  Scene scene;
  add(scene, Plate{-1.4, -1.1, 0.3, 0.2, 3});
  add(scene, Plate{-0.2, -0.4, 1.2, 1.3, 4.2});
  add(scene, sphere_mesh({0.9, -0.8, 5}, 0.5, 3));
  // Ends of domain differ, and some rays have none.
  add(scene, Plate{-9, -9, 0.4, 9, 7});
  add(scene, Plate{-0.5, -0.3, 0.2, 0.5, 6}, Roles::receiver);
  return scene;
}

Light key_light() {
  Light light = rect_light(1.5, 1);
  set_view(light, 0.5, 0.4, 2.5, 8);
  return light;
}

BakeOptions level_options(const Size& size, double epsilon, std::uint32_t levels) {
  BakeOptions options = small_options(size.width, size.height, 12);
  options.epsilon = epsilon;
  options.bias = 0.02;
  options.mip_levels = levels;
  return options;
}

/// Adds the changes of a lossless function's counts to those at the depths of its events.
void add_changes(const BakedFunctions& exact, std::uint32_t i, std::uint32_t j,
                 std::map<float, std::int64_t>& changes) {
  std::int64_t before = 0;
  for (const FunctionVertex& vertex : exact.function(i, j)) {
    const double depth = decode_depth(exact.view(), exact.map().coding, vertex.depth);
    changes[static_cast<float>(depth)] += vertex.begin - before;
    before = vertex.begin;
  }
}

/// The sum over the children of texel (i, j), from level 0 alone.
StepFunction sum_children(const BakedFunctions& exact, std::uint32_t i, std::uint32_t j,
                          std::uint32_t level) {
  const std::uint32_t edge = 1u << level;
  std::map<float, std::int64_t> changes;
  for (std::uint32_t y = j * edge; y < (j + 1) * edge; ++y) {
    for (std::uint32_t x = i * edge; x < (i + 1) * edge; ++x) add_changes(exact, x, y, changes);
  }
  StepFunction function;
  std::int64_t count = 0;
  for (const auto& [depth, change] : changes) {
    count += change;
    if (change == 0) continue;
    function.depth.push_back(depth);
    function.count.push_back(static_cast<std::uint32_t>(count));
  }
  return function;
}

void expect_within_tube(const BakedFunctions& baked, const std::vector<FunctionVertex>& vertices,
                        const StepTruth& truth, double epsilon) {
  const View& view = baked.view();
  const double tolerance = baked.report().depth_tolerance, delta = tolerance + depth_slack(view);
  for (const double z : critical_depths(view, baked.map().coding, vertices, truth, tolerance)) {
    const double value = evaluate_function(view, baked.map().coding, vertices, z);
    ASSERT_GE(value, truth.least(z, delta) - epsilon - kValueSlack) << "z " << z;
    ASSERT_LE(value, truth.greatest(z, delta) + epsilon + kValueSlack) << "z " << z;
  }
}

/// How many levels above 0 a map of this size can have.
std::uint32_t most_levels(const Size& size) {
  std::uint32_t levels = 0;
  while (levels < kMostMipLevels && std::min(size.width, size.height) >> (levels + 1) > 0) ++levels;
  return levels;
}

class MipLevels : public testing::TestWithParam<Size> {
 protected:
  [[nodiscard]] static BakedFunctions exact_bake() {
    BakeOptions options = level_options(GetParam(), 0, 0);
    options.depth_tolerance = 0;
    return {plates_and_sphere(), key_light(), options};
  }
  [[nodiscard]] static BakedFunctions level_bake(double epsilon, Receivers receivers = Receivers::volume) {
    BakeOptions options = level_options(GetParam(), epsilon, kMostMipLevels);
    options.receivers = receivers;
    return {plates_and_sphere(), key_light(), options};
  }
  static void expect_means(const BakedFunctions& baked, const BakedFunctions& exact, double epsilon) {
    ASSERT_EQ(exact.map().coding.depth_bits, 32u);
    ASSERT_GT(exact.vertex_count(), baked.report().texels) << "functions must hold something";
    for (std::uint32_t level = 1; level < baked.map().images.size(); ++level) {
      const FunctionImage& image = baked.map().images[level];
      const std::uint32_t total = baked.report().samples << (2 * level);
      for (std::uint32_t j = 0; j < image.height; ++j) {
        for (std::uint32_t i = 0; i < image.width; ++i) {
          SCOPED_TRACE(testing::Message() << "level " << level << ", texel " << i << ", " << j);
          const StepTruth truth(sum_children(exact, i, j, level), total);
          expect_within_tube(baked, baked.function(i, j, level), truth, epsilon);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
};

TEST_P(MipLevels, AreHalvedUntilASideIsOneTexel) {
  for (std::uint32_t asked = 0; asked <= kMostMipLevels; ++asked) {
    const BakedFunctions baked(plates_and_sphere(), key_light(), level_options(GetParam(), 0.02, asked));
    const std::uint32_t levels = std::min(asked, most_levels(GetParam()));
    EXPECT_EQ(baked.report().mip_levels, levels);
    ASSERT_EQ(baked.map().images.size(), levels + 1);
    for (std::uint32_t level = 0; level <= levels; ++level) {
      const FunctionImage& image = baked.map().images[level];
      EXPECT_EQ(image.level, level);
      EXPECT_EQ(image.width, GetParam().width >> level);
      EXPECT_EQ(image.height, GetParam().height >> level);
    }
    EXPECT_EQ(find_invariant_fault(baked.map()), "");
  }
}

TEST_P(MipLevels, HoldTheMeanWithinTheTube) {
  const BakedFunctions exact = exact_bake();
  for (const double epsilon : {0.02, 0.004}) {
    SCOPED_TRACE(epsilon);
    expect_means(level_bake(epsilon), exact, epsilon);
  }
}

/// A mean of counts is none: lossless, the nearest is stored, within 1 / 2N.
TEST_P(MipLevels, HoldTheNearestCountWithoutEpsilon) {
  const BakedFunctions exact = exact_bake();
  for (const double epsilon : {0.0, 1e-6}) {
    const BakedFunctions baked = level_bake(epsilon);
    ASSERT_EQ(baked.map().coding.value_max, baked.report().samples);
    expect_means(baked, exact, 0.5 / baked.report().samples);
  }
}

/// Functions exact to far have no ends; those of surfaces alone keep the tube everywhere at levels above 0.
TEST_P(MipLevels, HoldTheMeanForAllReceiversAndForSurfaces) {
  expect_means(level_bake(0.02, Receivers::surfaces), exact_bake(), 0.02);
  BakeOptions options = level_options(GetParam(), 0, 0);
  options.depth_tolerance = 0;
  options.receivers = Receivers::all;
  const BakedFunctions exact(plates_and_sphere(), key_light(), options);
  const BakedFunctions baked = level_bake(0.02, Receivers::all);
  expect_means(baked, exact, 0.02);
  for (const FunctionImage& image : baked.map().images) {
    for (const FunctionBlock& block : image.blocks) EXPECT_TRUE(block.domain_end.empty());
  }
}

TEST_P(MipLevels, EndWhereTheLastOfTheirChildrenDoes) {
  const BakedFunctions baked = level_bake(0.02);
  for (std::uint32_t level = 1; level < baked.map().images.size(); ++level) {
    const FunctionImage& image = baked.map().images[level];
    const std::uint32_t edge = 1u << level;
    for (std::uint32_t j = 0; j < image.height; ++j) {
      for (std::uint32_t i = 0; i < image.width; ++i) {
        std::uint32_t last = 0;
        for (std::uint32_t n = 0; n < edge * edge; ++n)
          last = std::max(last, baked.end_code(i * edge + n % edge, j * edge + n / edge).value());
        ASSERT_EQ(baked.end_code(i, j, level), last) << "level " << level << ", texel " << i << ", " << j;
      }
    }
  }
}

TEST_P(MipLevels, LeaveLevelZeroAsItIs) {
  for (const double epsilon : {0.0, 0.02}) {
    const BakedFunctions without(plates_and_sphere(), key_light(), level_options(GetParam(), epsilon, 0));
    expect_same_level(without, level_bake(epsilon), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(EverySize, MipLevels, testing::ValuesIn(kSizes), [](const auto& size) {
  return "Map" + std::to_string(size.param.width) + "x" + std::to_string(size.param.height);
});

TEST(MipLevelsOfNothing, AreEmpty) {
  Scene floor;
  add(floor, Plate{-9, -9, 9, 9, 7}, Roles::receiver);
  for (const Scene& scene : {Scene{}, floor}) {
    const BakedFunctions baked(scene, key_light(), level_options({70, 130}, 0.02, kMostMipLevels));
    ASSERT_EQ(baked.map().images.size(), 7u);
    EXPECT_EQ(find_invariant_fault(baked.map()), "");
    for (const FunctionImage& image : baked.map().images) {
      for (const FunctionBlock& block : image.blocks) EXPECT_TRUE(block.words.empty());
    }
    EXPECT_EQ(baked.end_code(0, 1, 6), baked.end_code(0, 64));
  }
}

/// Where all children are in umbra, so is their mean: exactly.
TEST(MipLevelsOfUmbra, AreOne) {
  Scene scene;
  add(scene, Plate{-kWide, -kWide, kWide, kWide, 4});
  add(scene, Plate{-9, -9, 9, 9, 7});
  for (const double epsilon : {0.0, 0.02}) {
    const BakedFunctions baked(scene, key_light(), level_options({130, 70}, epsilon, kMostMipLevels));
    for (std::uint32_t level = 0; level <= 6; ++level) {
      const std::vector<FunctionVertex> function = baked.function(0, 0, level);
      ASSERT_FALSE(function.empty());
      EXPECT_EQ(function.back().begin, baked.map().coding.value_max) << "level " << level;
    }
  }
}

/// The plan counts what levels take, in the map and while they are fitted; a prediction tells it.
TEST(MipLevelsCost, IsPlanned) {
  const BakeOptions options = level_options({128, 128}, 0.02, 0);
  const BakedFunctions baked(plates_and_sphere(), key_light(), options);
  const MapGrid grid = make_map_grid(baked.view(), options.width, options.height);
  TilePlan before = plan_tiles({grid, baked.map().samples, Walk::exact, 2, options.memory, 0, 0});
  for (std::uint32_t levels = 1; levels <= kMostMipLevels; ++levels) {
    const TilePlan plan = plan_tiles({grid, baked.map().samples, Walk::exact, 2, options.memory, 0, levels});
    EXPECT_GT(plan.output_bytes, before.output_bytes) << levels;
    EXPECT_GT(plan.map_bytes, before.map_bytes) << levels;
    before = plan;
  }
  const BakeOptions with = level_options({128, 128}, 0.02, kMostMipLevels);
  EXPECT_GT(predict_bake(plates_and_sphere(), key_light(), with).memory_bytes,
            predict_bake(plates_and_sphere(), key_light(), options).memory_bytes);
}

}  // namespace
}  // namespace pdsm::test
