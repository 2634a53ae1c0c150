// SPDX-License-Identifier: Apache-2.0
// The promise of the fit (numerics.md section 4): for every z, quantisation included,
//   min over |s| <= delta of V(z + s) - epsilon  <=  V'(z)  <=  max over |s| <= delta of V(z + s) + epsilon
// V is a step function and V' piecewise linear, so checking both sides of all vertices and of all depths at
// delta from an event is exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "fit/fit_function.h"
#include "support/step_functions.h"

namespace pdsm::test {
namespace {

constexpr double kEpsilons[] = {0, 1e-6, 0.002, 0.005, 0.01, 0.02, 0.05, 0.3, 0.9};
constexpr std::uint32_t kSampleCounts[] = {1, 2, 7, 256, 65535, 65536};
/// Rounding of V and of its bounds in double, each a few operations on numbers up to 1.
constexpr double kValueSlack = 1e-12;

struct Depths {
  double near_depth, far_depth;
};
constexpr Depths kDepths[] = {{7.8, 13.7}, {0.1, 100}, {1, 1.001}, {0.001, 1000}};

/// delta as a share of the depth range: none, half a code of 32 and of 16 bits, small, large, beyond all.
constexpr double kDeltaShares[] = {0, 1.2e-10, 7.6e-6, 4e-5, 1e-3, 0.05, 2};

std::vector<FunctionVertex> fit(const StepFunction& function, const FitRules& rules) {
  FitWorkspace room;
  std::vector<FunctionVertex> vertices;
  fit_function(function, rules, room, vertices);
  return pack_and_unpack(rules.coding, vertices);
}

/// Strictly increasing depth codes, value codes in range, and a constant to end with.
void expect_valid(const VertexCoding& coding, const std::vector<FunctionVertex>& vertices) {
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    ASSERT_LE(vertices[n].depth, coding.depth_max());
    ASSERT_LE(vertices[n].begin, coding.value_max);
    ASSERT_LE(vertices[n].end, coding.value_max);
    ASSERT_TRUE(n == 0 || vertices[n - 1].depth < vertices[n].depth) << "vertex " << n;
  }
  ASSERT_TRUE(vertices.empty() || vertices.back().begin == vertices.back().end);
}

/// The epsilon that is promised: a mip level's means of counts are codes only within half of one.
double promised_epsilon(const FitRules& rules) {
  const bool is_level = rules.sample_count != rules.coding.value_max;
  return rules.constant_pieces && is_level ? std::max(rules.epsilon, 0.5 / rules.coding.value_max)
                                           : rules.epsilon;
}

void expect_within_tube(const View& view, const StepFunction& function, const FitRules& rules,
                        const std::vector<FunctionVertex>& vertices) {
  const double epsilon = promised_epsilon(rules);
  const StepTruth truth(function, rules.sample_count);
  const double delta = rules.tolerance + depth_slack(view);
  for (const double z : critical_depths(view, rules.coding, vertices, truth, rules.tolerance)) {
    const double value = evaluate_function(view, rules.coding, vertices, z);
    ASSERT_GE(value, truth.least(z, delta) - epsilon - kValueSlack) << "z " << z;
    ASSERT_LE(value, truth.greatest(z, delta) + epsilon + kValueSlack) << "z " << z;
  }
  EXPECT_EQ(evaluate_function(view, rules.coding, vertices, view.near_depth), 0);
  // What a function holds behind far is V's last value, without any delta.
  const double held = evaluate_function(view, rules.coding, vertices, 10 * view.far_depth);
  EXPECT_NEAR(held, truth.last(), epsilon + kValueSlack);
}

class FitPromise : public testing::TestWithParam<double> {};

TEST_P(FitPromise, HoldsForEveryShapeSampleCountAndTolerance) {
  const double epsilon = GetParam();
  Random random(11);
  for (const std::uint32_t samples : kSampleCounts) {
    for (const Depths& depths : kDepths) {
      const View view = depth_view(depths.near_depth, depths.far_depth);
      for (const double share : kDeltaShares) {
        const double delta = share * (view.far_depth - view.near_depth);
        const FitRules rules = make_fit_rules(view, samples, epsilon, delta);
        for (int n = 0; n < 4 * static_cast<int>(std::size(kShapes)); ++n) {
          const Shape shape = kShapes[static_cast<std::size_t>(n) % std::size(kShapes)];
          const std::uint32_t steps = random.pick({1u, 3u, 12u, 60u});
          const StepFunction function = random_steps(random, shape, view, samples, delta, steps);
          if (function.depth.empty()) continue;
          SCOPED_TRACE(testing::Message()
                       << "N " << samples << ", near " << view.near_depth << ", far " << view.far_depth
                       << ", delta " << delta << ", shape " << static_cast<int>(shape));
          const std::vector<FunctionVertex> vertices = fit(function, rules);
          expect_valid(rules.coding, vertices);
          expect_within_tube(view, function, rules, vertices);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

/// 20 000 plates on one ray, each seen by all samples or by any number of them.
TEST_P(FitPromise, HoldsForACombOfTwentyThousandSteps) {
  const View view = depth_view(1, 100);
  Random random(12);
  for (const double delta : {0.0, 0.0005, 0.02, 1.0}) {
    for (const Shape shape : {Shape::blinking, Shape::wandering, Shape::hump}) {
      const FitRules rules = make_fit_rules(view, 256, GetParam(), delta);
      const StepFunction function = random_steps(random, shape, view, 256, delta, 20000);
      SCOPED_TRACE(testing::Message() << "delta " << delta << ", shape " << static_cast<int>(shape));
      const std::vector<FunctionVertex> vertices = fit(function, rules);
      expect_valid(rules.coding, vertices);
      expect_within_tube(view, function, rules, vertices);
      if (HasFatalFailure()) return;
    }
  }
}

/// Counts up to 4^6 x 65536, of which a code is far less than one.
TEST_P(FitPromise, HoldsForMipLevels) {
  const View view = depth_view(1, 100);
  Random random(15);
  for (const std::uint32_t samples : kSampleCounts) {
    for (const std::uint32_t level : {1u, 6u}) {
      for (const double delta : {0.0, 0.02}) {
        const FitRules rules = make_level_rules(make_fit_rules(view, samples, GetParam(), delta), level);
        for (const Shape shape : kShapes) {
          const StepFunction function = random_steps(random, shape, view, rules.sample_count, delta, 300);
          if (function.depth.empty()) continue;
          SCOPED_TRACE(testing::Message() << "N " << samples << ", level " << level << ", delta " << delta
                                          << ", shape " << static_cast<int>(shape));
          const std::vector<FunctionVertex> vertices = fit(function, rules);
          expect_valid(rules.coding, vertices);
          expect_within_tube(view, function, rules, vertices);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryEpsilon, FitPromise, testing::ValuesIn(kEpsilons));

TEST(Fit, OfNoStepsIsEmpty) {
  const FitRules rules = make_fit_rules(depth_view(1, 10), 256, 0.02, 0.01);
  EXPECT_TRUE(fit({}, rules).empty());
}

/// Lossless: at every depth further than delta from an event the decoded value is the count, to the bit.
TEST(Fit, WithoutEpsilonKeepsCounts) {
  Random random(13);
  for (const std::uint32_t samples : kSampleCounts) {
    for (const Shape shape : kShapes) {
      for (const double share : {0.0, 1e-4}) {
        const View view = depth_view(2, 9);
        const double delta = share * 7;
        const FitRules rules = make_fit_rules(view, samples, 0, delta);
        const StepFunction function = random_steps(random, shape, view, samples, delta, 50);
        const StepTruth truth(function, samples);
        const std::vector<FunctionVertex> vertices = fit(function, rules);
        for (int n = 0; n < 2000; ++n) {
          const double z = random.uniform(2, 9), reach = rules.tolerance + depth_slack(view);
          if (truth.least(z, reach) != truth.greatest(z, reach)) continue;
          const double value = evaluate_function(view, rules.coding, vertices, z);
          ASSERT_EQ(std::lround(value * samples), std::lround(truth.at(z) * samples)) << "z " << z;
          ASSERT_EQ(rules.coding.value_max, samples);
        }
      }
    }
  }
}

/// A jump is two values at one depth, not a slope: no value in between, ever.
TEST(Fit, OfAStepWithoutEpsilonIsOneVertex) {
  const View view = depth_view(1, 5);
  const FitRules rules = make_fit_rules(view, 256, 0, 0.001);
  const std::vector<FunctionVertex> vertices = fit({{3.0F}, {256}}, rules);
  ASSERT_EQ(vertices.size(), 1u);
  EXPECT_EQ(vertices[0].begin, rules.coding.value_max);
  EXPECT_NEAR(decode_depth(view, rules.coding, vertices[0].depth), 3.0, rules.tolerance);
}

/// What is held for ever is V's last value exactly, where the fewest pieces leave the choice: a single jump
/// does (a penumbra's end may be cut off within epsilon).
TEST(Fit, KeepsTheUmbraBehindAJumpExact) {
  Random random(14);
  const View view = depth_view(1, 5);
  for (const double epsilon : kEpsilons) {
    for (const std::uint32_t samples : kSampleCounts) {
      const FitRules rules = make_fit_rules(view, samples, epsilon, 0.001);
      StepFunction function = random_steps(random, Shape::single, view, samples, 0.001, 1);
      function.count = {samples};
      const std::vector<FunctionVertex> vertices = fit(function, rules);
      ASSERT_EQ(vertices.size(), 1u) << "epsilon " << epsilon << ", N " << samples;
      EXPECT_EQ(vertices[0].begin, rules.coding.value_max) << "epsilon " << epsilon << ", N " << samples;
    }
  }
}

}  // namespace
}  // namespace pdsm::test
