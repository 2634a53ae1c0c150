// SPDX-License-Identifier: Apache-2.0
#include "choose/choice.h"

#include <gtest/gtest.h>

#include "known_laws.h"

namespace pdsm {
namespace {

const Settings kBase{64, 256, 256, 0.01};

Laws known_laws() {
  return Laws(KnownLaws().star(kBase));
}

TEST(Choice, TheTargetHoldsAndNothingNearIsCheaper) {
  const Laws laws = known_laws();
  for (const double target : {0.1, 0.03, 0.01, 0.004}) {
    const Limits limits{.error = target};
    const auto best = choose_settings(laws, {}, limits, Wish::least_cost);
    ASSERT_TRUE(best) << target;
    EXPECT_LE(laws.error(*best), target);
    // Around the choice, whatever holds the target costs as much: steps of a fifth in each setting.
    for (const double n : {0.5, 0.84, 1.0, 1.19, 2.0}) {
      for (const double e : {0.5, 0.84, 1.0, 1.19, 2.0}) {
        for (const std::uint32_t shrink : {0U, 64U}) {
          Settings other = *best;
          other.samples = std::max(64U, static_cast<std::uint32_t>(n * best->samples));
          other.epsilon = std::min(0.05, e * best->epsilon);
          other.width = other.height = best->width > 2 * shrink ? best->width - shrink : best->width;
          if (laws.error(other) > target) continue;
          // Texels come in steps of 1/16 octave, samples and epsilon of 1/4: what lies between may gain a
          // step of one of them, 2^(1/4) of the cost at most by samples or epsilon, 2^(4/16) by the edge.
          EXPECT_GE(cost_of(laws, other), cost_of(laws, *best) / 1.2) << settings_text(other);
        }
      }
    }
  }
}

TEST(Choice, BudgetsHold) {
  const Laws laws = known_laws();
  for (const double bytes : {1e4, 1e5, 1e6, 1e7}) {
    const Limits limits{.bytes = bytes};
    const auto best = choose_settings(laws, {}, limits, Wish::least_error);
    ASSERT_TRUE(best) << bytes;
    EXPECT_LE(laws.bytes(*best), bytes);
    // An error of less than this is worth its bytes: the budget is used, but for a step of the edge.
    EXPECT_GE(laws.bytes(*best), 0.7 * bytes);
  }
  const Limits limits{.seconds = 10};
  const auto best = choose_settings(laws, {}, limits, Wish::least_error);
  ASSERT_TRUE(best);
  EXPECT_LE(laws.seconds(*best), 10);
  EXPECT_GE(laws.seconds(*best), 7);
}

TEST(Choice, MoreBudgetNeverMeansMoreError) {
  const Laws laws = known_laws();
  double last = std::numeric_limits<double>::infinity();
  for (double bytes = 1e4; bytes < 1e9; bytes *= 2) {
    const auto best = choose_settings(laws, {}, {.bytes = bytes}, Wish::least_error);
    ASSERT_TRUE(best);
    EXPECT_LE(laws.error(*best), last) << bytes;
    last = laws.error(*best);
  }
}

TEST(Choice, FixedOnesAreKept) {
  const Laws laws = known_laws();
  const Settings given{100, 300, 200, 0.02};
  ChoiceSpace space{{true, false, false}, given};
  EXPECT_EQ(choose_settings(laws, space, {.error = 0.02}, Wish::least_cost)->samples, 100U);
  space.fixed = {false, true, false};
  const auto sized = choose_settings(laws, space, {.error = 0.03}, Wish::least_cost);
  EXPECT_EQ(sized->width, 300U);
  EXPECT_EQ(sized->height, 200U);
  space.fixed = {false, false, true};
  EXPECT_EQ(choose_settings(laws, space, {.error = 0.02}, Wish::least_cost)->epsilon, 0.02);
  space.fixed = {true, true, true};
  EXPECT_EQ(choose_settings(laws, space, {.error = 1}, Wish::least_cost), given);
  EXPECT_EQ(choose_settings(laws, space, {.error = 1e-3}, Wish::least_cost), std::nullopt);
}

TEST(Choice, TexelsAreSquare) {
  ChoiceSpace space;
  space.aspect = 4;
  const auto best = choose_settings(known_laws(), space, {.error = 0.01}, Wish::least_cost);
  ASSERT_TRUE(best);
  // Sides are multiples of 8.
  EXPECT_NEAR(best->width, 4.0 * best->height, 4 * 4 + 4);
}

TEST(Choice, WhatCanNotBeHasNoSettings) {
  const Laws laws = known_laws();
  EXPECT_EQ(choose_settings(laws, {}, {.error = 1e-6}, Wish::least_cost), std::nullopt);
  EXPECT_EQ(choose_settings(laws, {}, {.error = 0.01, .bytes = 1000}, Wish::least_cost), std::nullopt);
  EXPECT_EQ(choose_settings(laws, {}, {.error = 0.001, .edge = 512}, Wish::least_cost), std::nullopt);
  const auto exact = most_exact_settings(laws, {}, {.error = 1e-6});
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->samples, 65536U);
  EXPECT_EQ(exact->width, 16384U);
}

}  // namespace
}  // namespace pdsm
