// SPDX-License-Identifier: Apache-2.0
// Codings are the smallest that serve: fit_rules.h says which.
#include "fit/fit_rules.h"

#include <gtest/gtest.h>

#include "support/step_functions.h"

namespace pdsm::test {
namespace {

FitRules rules_for(std::uint32_t samples, double epsilon, double delta) {
  return make_fit_rules(depth_view(1, 1 + 65535 * 0.001), samples, epsilon, delta);
}

TEST(FitRules, ValuesTakeEightBitsWhileACodeIsAQuarterOfTheTube) {
  // 2 epsilon >= 4 / 255.
  for (const double epsilon : {0.99, 0.3, 0.02, 2.001 / 255}) {
    const FitRules rules = rules_for(256, epsilon, 0.1);
    EXPECT_EQ(rules.coding.value_bits, 8u) << epsilon;
    EXPECT_EQ(rules.coding.value_max, 255u) << epsilon;
    EXPECT_FALSE(rules.constant_pieces) << epsilon;
  }
  for (const double epsilon : {1.999 / 255, 0.001, 2.001 / 65535}) {
    const FitRules rules = rules_for(256, epsilon, 0.1);
    EXPECT_EQ(rules.coding.value_bits, 16u) << epsilon;
    EXPECT_EQ(rules.coding.value_max, 65535u) << epsilon;
    EXPECT_FALSE(rules.constant_pieces) << epsilon;
  }
}

TEST(FitRules, WithoutEpsilonValuesAreCountsAsWideAsTheyNeed) {
  const auto bits = [](std::uint32_t samples, double epsilon) {
    const FitRules rules = rules_for(samples, epsilon, 0.1);
    EXPECT_TRUE(rules.constant_pieces);
    EXPECT_EQ(rules.coding.value_max, samples);
    return rules.coding.value_bits;
  };
  for (const double epsilon : {0.0, 1e-6, 1.999 / 65535}) {
    EXPECT_EQ(bits(1, epsilon), 8u);
    EXPECT_EQ(bits(255, epsilon), 8u);
    EXPECT_EQ(bits(256, epsilon), 16u);
    EXPECT_EQ(bits(65535, epsilon), 16u);
    EXPECT_EQ(bits(65536, epsilon), 32u);
  }
}

TEST(FitRules, DepthsTakeSixteenBitsWhileDeltaHoldsTwoSteps) {
  // A step of 16 bits is a millimetre here.
  EXPECT_EQ(rules_for(256, 0.02, 0.0021).coding.depth_bits, 16u);
  EXPECT_EQ(rules_for(256, 0.02, 0.0019).coding.depth_bits, 32u);
  EXPECT_EQ(rules_for(256, 0.02, 0).coding.depth_bits, 32u);
  EXPECT_EQ(rules_for(256, 0, 0.0021).coding.depth_bits, 16u);
}

TEST(FitRules, DeltaIsKeptUnlessNoCodeFitsIn) {
  for (const double delta : {0.0019, 0.0021, 1.0})
    EXPECT_DOUBLE_EQ(rules_for(256, 0.02, delta).tolerance, delta);
  const FitRules least = rules_for(256, 0.02, 0);
  const double step = depth_step(depth_view(1, 1 + 65535 * 0.001), least.coding);
  EXPECT_DOUBLE_EQ(least.tolerance, step / 2);
  EXPECT_DOUBLE_EQ(least.tolerance_codes, 0.5);
}

/// The bounds leave room for rounding a line's ends, half a code each, and never leave 0 .. 1.
TEST(FitRules, BoundsLieWithinEpsilonLessAHalfCode) {
  for (const std::uint32_t samples : {1u, 2u, 7u, 256u, 65535u, 65536u}) {
    for (const double epsilon : {0.0, 1e-6, 0.002, 0.01, 0.02, 0.3, 0.9}) {
      const FitRules rules = rules_for(samples, epsilon, 0.1);
      const double unit = 1.0 / (static_cast<double>(kValueScale) * rules.coding.value_max);
      const double half = rules.constant_pieces ? 0 : 0.5 / rules.coding.value_max;
      ASSERT_EQ(rules.lower.size(), samples + 1u);
      for (std::uint32_t count = 0; count <= samples; ++count) {
        const double v = static_cast<double>(count) / samples;
        const double low = static_cast<double>(rules.lower[count]) * unit,
                     high = static_cast<double>(rules.upper[count]) * unit;
        ASSERT_LE(low, high);
        ASSERT_GE(low, 0);
        ASSERT_LE(high, 1);
        // 1e-12: rounding of these doubles.
        ASSERT_TRUE(rules.lower[count] == 0 || low >= v - epsilon + half - 1e-12);
        ASSERT_TRUE(high == 1 || high <= v + epsilon - half + 1e-12);
      }
    }
  }
}

/// The tables of level 0 are the formula; a level has the formula alone, which goes on up to 4^6 x 65536.
TEST(FitRules, BoundsOfALevelLieWithinEpsilonOfTheMean) {
  for (const std::uint32_t samples : {1u, 7u, 256u, 65535u, 65536u}) {
    for (const double epsilon : {0.0, 1e-6, 0.002, 0.02, 0.9}) {
      const FitRules base = rules_for(samples, epsilon, 0.1);
      for (const std::uint32_t level : {1u, 3u, 6u}) {
        const FitRules rules = make_level_rules(base, level);
        ASSERT_EQ(rules.sample_count, samples << (2 * level));
        ASSERT_EQ(rules.coding, base.coding);
        ASSERT_TRUE(rules.lower.empty() && rules.upper.empty());
        const double unit = 1.0 / (static_cast<double>(kValueScale) * rules.coding.value_max);
        const double half = rules.constant_pieces ? 0 : 0.5 / rules.coding.value_max;
        const double most = rules.constant_pieces ? std::max(epsilon, 0.5 / samples) : epsilon;
        for (std::uint32_t n = 0; n <= 1000; ++n) {
          const auto count = static_cast<std::uint32_t>(std::uint64_t{rules.sample_count} * n / 1000);
          const double v = static_cast<double>(count) / rules.sample_count;
          const double low = static_cast<double>(rules.lower_of(count)) * unit,
                       high = static_cast<double>(rules.upper_of(count)) * unit;
          ASSERT_TRUE(0 <= low && low <= high && high <= 1) << v;
          ASSERT_TRUE(low == 0 || low >= v - most + half - 1e-12) << v;
          ASSERT_TRUE(high == 1 || high <= v + most - half + 1e-12) << v;
        }
      }
      for (std::uint32_t count = 0; count <= samples; ++count) {
        ASSERT_EQ(base.lower_of(count), base.bounds_of(count).lower);
        ASSERT_EQ(base.upper_of(count), base.bounds_of(count).upper);
      }
    }
  }
}

}  // namespace
}  // namespace pdsm::test
