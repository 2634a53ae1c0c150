// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tube_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "small_sweep.h"
#include "tradeoff/settings.h"
#include "truth/random.h"

namespace pdsm {
namespace {

/// Rounding of a few sums and products of numbers up to 1.
constexpr double kRounding = 1e-14;

TEST(TubeMargin, OfTheFunctionItselfIsEpsilon) {
  const DepthSteps steps{{2, 3}, {0.5, 1}};
  EXPECT_NEAR(tube_margin(steps, {{2, 3}, {0.5, 1}, {0.5, 1}}, 1, 0.02, 0), 0.02, kRounding);
  EXPECT_EQ(tube_margin({}, {}, 1, 0.02, 0.1), 0.02);
  EXPECT_EQ(tube_margin(steps, {{2, 3}, {0.5, 1}, {0.5, 1}}, 1, 0, 0), 0);
}

TEST(TubeMargin, LetsAStepMoveByDeltaAndNoFurther) {
  const DepthSteps step{{2}, {0.5}};
  for (const double moved : {-0.125, 0.125}) {
    const DepthPieces fitted{{2 + moved}, {0.5}, {0.5}};
    EXPECT_NEAR(tube_margin(step, fitted, 1, 0.02, 0.125), 0.02, kRounding) << moved;
    EXPECT_NEAR(tube_margin(step, fitted, 1, 0.02, 0.124), 0.02 - 0.5, kRounding) << moved;
  }
}

// V steps by 0.5 at 2 and at 4; V' rises straight from 0 at 1 to 1 at 5. Just behind 2 - delta the window
// [z - delta, z + delta] holds 0 and 0.5; V' leaves furthest just behind 2 + delta (V = 0.5, V' = (1 + delta)
// / 4) and just before 4 - delta, by 0.5 - epsilon - (1 + delta) / 4.
TEST(TubeMargin, FindsWhereASlopeLeaves) {
  const DepthSteps steps{{2, 4}, {0.5, 1}};
  const DepthPieces slope{{1, 5}, {0, 1}, {1, 1}};
  const double delta = 0.25, epsilon = 0.1;
  EXPECT_NEAR(tube_margin(steps, slope, 1, epsilon, delta), epsilon + (1 + delta) / 4 - 0.5, kRounding);
}

TEST(TubeMargin, LooksBehindTheLastVertexAndBeforeTheFirst) {
  EXPECT_NEAR(tube_margin({{2, 9}, {0.5, 1}}, {{2}, {0.5}, {0.5}}, 1, 0.1, 0.01), -0.4, kRounding);
  EXPECT_NEAR(tube_margin({{2, 9}, {0.5, 0}}, {{9}, {0}, {0}}, 1, 0.1, 0.01), -0.4, kRounding);
  EXPECT_NEAR(tube_margin({}, {{3}, {0.25}, {0.25}}, 1, 0.1, 1), -0.15, kRounding);
  EXPECT_NEAR(tube_margin({{3}, {0.25}}, {}, 1, 0.1, 1), -0.15, kRounding);
}

double value_at(const DepthSteps& steps, double z) {
  double value = 0;
  for (std::size_t n = 0; n < steps.depth.size() && steps.depth[n] < z; ++n) value = steps.value[n];
  return value;
}

double value_at(const DepthPieces& pieces, double z) {
  double value = 0;
  for (std::size_t n = 0; n < pieces.depth.size() && pieces.depth[n] < z; ++n) {
    value = pieces.begin[n];
    if (n + 1 == pieces.depth.size()) break;
    const double share = (z - pieces.depth[n]) / (pieces.depth[n + 1] - pieces.depth[n]);
    value += share * (pieces.end[n] - pieces.begin[n]);
  }
  return value;
}

/// The margin at one depth, from the promise as it is written down.
double margin_at(const DepthSteps& steps, const DepthPieces& pieces, double z, double epsilon, double delta) {
  // Any depth of the window, and just behind each step in it.
  double least = value_at(steps, z - delta), greatest = least;
  for (std::size_t n = 0; n < steps.depth.size(); ++n) {
    if (steps.depth[n] < z - delta || steps.depth[n] >= z + delta) continue;
    least = std::min(least, steps.value[n]);
    greatest = std::max(greatest, steps.value[n]);
  }
  const double value = value_at(pieces, z);
  return std::min(value - (least - epsilon), greatest + epsilon - value);
}

struct RandomPair {
  DepthSteps steps;
  DepthPieces pieces;
};

RandomPair random_pair(std::uint64_t seed) {
  std::uint64_t drawn = 0;
  const auto next = [&] { return hash_unit(seed, drawn++); };
  const auto depths = [&](std::size_t count) {
    std::vector<double> z;
    for (std::size_t n = 0; n < count; ++n) z.push_back(1 + 8 * next());
    std::sort(z.begin(), z.end());
    z.erase(std::unique(z.begin(), z.end()), z.end());
    return z;
  };
  RandomPair pair;
  pair.steps.depth = depths(static_cast<std::size_t>(12 * next()));
  for (std::size_t n = 0; n < pair.steps.depth.size(); ++n) pair.steps.value.push_back(next());
  pair.pieces.depth = depths(static_cast<std::size_t>(6 * next()));
  for (std::size_t n = 0; n < pair.pieces.depth.size(); ++n) {
    pair.pieces.begin.push_back(next());
    pair.pieces.end.push_back(n + 1 == pair.pieces.depth.size() ? pair.pieces.begin.back() : next());
  }
  return pair;
}

// No depth has less margin than tube_margin() says, and some depth comes as near to it as the step of the
// search allows: between two depths searched V' moves by at most its steepest slope times their distance.
TEST(TubeMargin, IsTheLeastOverAllDepths) {
  constexpr double kStep = 1e-3;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const RandomPair pair = random_pair(seed);
    const double delta = seed % 3 == 0 ? 0.01 : 0.2, epsilon = 0.05;
    const double margin = tube_margin(pair.steps, pair.pieces, 1, epsilon, delta);
    std::vector<double> at;
    for (double z = 1 + kStep; z < 10; z += kStep) at.push_back(z);
    // Both sides of where anything happens.
    std::vector<double> special(pair.pieces.depth);
    for (const double depth : pair.steps.depth) special.insert(special.end(), {depth - delta, depth + delta});
    constexpr double kBeside = 1e-9;
    for (const double z : special) at.insert(at.end(), {z - kBeside, z + kBeside});
    double steepest = 0, least = 1e9;
    for (std::size_t n = 0; n + 1 < pair.pieces.depth.size(); ++n) {
      steepest = std::max(steepest, std::abs(pair.pieces.end[n] - pair.pieces.begin[n]) /
                                        (pair.pieces.depth[n + 1] - pair.pieces.depth[n]));
    }
    for (const double z : at) {
      if (z > 1) least = std::min(least, margin_at(pair.steps, pair.pieces, z, epsilon, delta));
    }
    ASSERT_LE(margin, least + 1e-12) << "seed " << seed;
    ASSERT_GE(margin, least - steepest * 2 * kBeside - 1e-12) << "seed " << seed;
  }
}

struct Bakes {
  BakeOptions options;
  std::vector<BakedMap> maps;
};

Bakes bake_epsilons(const Scene& scene, std::initializer_list<double> epsilons) {
  Bakes bakes;
  bakes.options.samples = 64;
  bakes.options.width = bakes.options.height = 70;  // more than a block
  for (const double epsilon : epsilons) {
    bakes.options.epsilon = epsilon;
    bakes.maps.push_back(bake(scene, scene.lights[0], bakes.options));
  }
  return bakes;
}

TEST(CheckTubes, EveryFunctionOfABakeIsWithinItsTube) {
  const Scene scene = small_scene();
  const Bakes bakes = bake_epsilons(scene, {0, 0.005, 0.02, 0.3});
  const std::vector<TubeCheck> checks = check_tubes(scene, scene.lights[0], bakes.options, bakes.maps, {});
  ASSERT_EQ(checks.size(), 4U);
  for (const TubeCheck& check : checks) {
    EXPECT_EQ(check.functions, 70U * 70U);
    EXPECT_EQ(check.outside, 0U);
    EXPECT_GE(check.worst_margin, -kTubeSlack);
  }
  // Without loss the values are the very counts; the widest tube is used, though not all of it.
  EXPECT_EQ(checks[0].worst_margin, 0);
  EXPECT_LT(checks[3].worst_margin, 0.1);
}

// A fit that promises less than it was made for leaves the narrower tube somewhere.
TEST(CheckTubes, SeesAFitThatBreaksItsPromise) {
  const Scene scene = small_scene();
  Bakes bakes = bake_epsilons(scene, {0.1});
  bakes.maps[0].report.epsilon = 0.05;
  const TubeCheck check = check_tubes(scene, scene.lights[0], bakes.options, bakes.maps, {})[0];
  EXPECT_GT(check.outside, 0U);
  EXPECT_LT(check.outside, check.functions);
  EXPECT_LT(check.worst_margin, -0.01);
  EXPECT_GE(check.worst_margin, 0.05 - 0.1 - kTubeSlack);
}

// The functions of another scene: the plate is gone.
TEST(CheckTubes, SeesFunctionsOfAnotherScene) {
  Scene scene = small_scene();
  const Bakes bakes = bake_epsilons(scene, {0.02});
  scene.geometry.front().casts = false;
  Light light = scene.lights[0];
  light.window = bakes.maps[0].map.views[0].window;
  light.near_depth = bakes.maps[0].map.views[0].near_depth;
  light.far_depth = bakes.maps[0].map.views[0].far_depth;
  const TubeCheck check = check_tubes(scene, light, bakes.options, bakes.maps, {})[0];
  EXPECT_GT(check.outside, 0U);
  EXPECT_NEAR(check.worst_margin, 0.02 - 1, kTubeSlack);
}

}  // namespace
}  // namespace pdsm
