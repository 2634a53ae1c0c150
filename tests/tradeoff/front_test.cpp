// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "truth/random.h"

namespace pdsm {
namespace {

/// Choices on a coarse grid, so that costs, errors and whole choices are often equal.
std::vector<Choice> random_choices(std::uint64_t seed, std::size_t count, double grid) {
  std::vector<Choice> choices;
  for (std::size_t n = 0; n < count; ++n) {
    choices.push_back(
        {std::floor(grid * hash_unit(seed, 2 * n)), std::floor(grid * hash_unit(seed, 2 * n + 1))});
  }
  return choices;
}

TEST(ParetoFront, HoldsExactlyWhatNothingDominates) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const double grid = seed % 2 == 0 ? 6 : 1000;
    const std::vector<Choice> choices = random_choices(seed, seed % 41, grid);
    const std::vector<bool> front = pareto_front(choices);
    ASSERT_EQ(front.size(), choices.size());
    for (std::size_t n = 0; n < choices.size(); ++n) {
      const bool dominated = std::any_of(choices.begin(), choices.end(),
                                         [&](const Choice& other) { return dominates(other, choices[n]); });
      ASSERT_EQ(front[n], !dominated) << "seed " << seed << ", choice " << n;
    }
  }
}

TEST(ParetoFront, EqualChoicesStandTogether) {
  const std::vector<Choice> choices{{1, 3}, {2, 2}, {2, 2}, {2, 3}, {3, 2}};
  EXPECT_EQ(pareto_front(choices), (std::vector<bool>{true, true, true, false, false}));
}

TEST(BestWithin, IsTheLeastErrorThatTheCostAllows) {
  const std::vector<Choice> choices{{1, 3}, {2, 2}, {4, 1}, {1.5, 2}};
  EXPECT_EQ(best_within(choices, 0.5), choices.size());
  EXPECT_EQ(best_within(choices, 1), 0U);
  EXPECT_EQ(best_within(choices, 2), 3U) << "of equal errors the cheaper";
  EXPECT_EQ(best_within(choices, 9), 2U);
}

}  // namespace
}  // namespace pdsm
