// SPDX-License-Identifier: Apache-2.0
#include "light/hilbert_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pdsm::test {
namespace {

TEST(HilbertCurve, GoesFromCellToNeighbour) {
  constexpr int kSide = 16;
  std::vector<glm::dvec3> points;
  for (int n = 0; n < kSide * kSide * kSide; ++n)
    points.emplace_back(3 + 0.5 * (n % kSide), 0.5 * (n / kSide % kSide) - 100, 0.5 * (n / kSide / kSide));
  std::ranges::shuffle(points, std::mt19937(1));
  sort_along_hilbert_curve(points);
  for (std::size_t n = 1; n < points.size(); ++n) EXPECT_EQ(glm::length(points[n] - points[n - 1]), 0.5) << n;
}

TEST(HilbertCurve, LeavesPointsOfOneCellAsTheyAre) {
  std::vector<glm::dvec3> same(3, glm::dvec3(1, 2, 3));
  sort_along_hilbert_curve(same);
  EXPECT_EQ(same, std::vector<glm::dvec3>(3, glm::dvec3(1, 2, 3)));
}

}  // namespace
}  // namespace pdsm::test
