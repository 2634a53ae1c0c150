// SPDX-License-Identifier: Apache-2.0
#include "truth/light_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "plates.h"

namespace pdsm {
namespace {

TEST(JitteredGrid, SquareNumbersFillEveryCellOnce) {
  for (const std::uint32_t side : {1U, 2U, 7U, 16U, 64U}) {
    const JitteredGrid grid(side * side);
    std::set<std::pair<int, int>> cells;
    for (std::uint32_t i = 0; i < side * side; ++i) {
      const auto [x, y] = grid.point(i, 3);
      ASSERT_GE(std::min(x, y), 0);
      ASSERT_LT(std::max(x, y), 1);
      cells.emplace(static_cast<int>(x * side), static_cast<int>(y * side));
    }
    EXPECT_EQ(cells.size(), std::size_t{side} * side) << side;
  }
}

TEST(JitteredGrid, JitterFillsTheCell) {
  constexpr std::uint32_t kSide = 64;
  const JitteredGrid grid(kSide * kSide);
  std::array<double, 2> least{1, 1}, most{0, 0};
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const std::array<double, 2> p = grid.point(i, 5);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double within = p[axis] * kSide - std::floor(p[axis] * kSide);
      least[axis] = std::min(least[axis], within);
      most[axis] = std::max(most[axis], within);
    }
  }
  // A hundredth at either end stays empty with probability 0.99^4096 = 1e-18.
  for (std::size_t axis = 0; axis < 2; ++axis) {
    EXPECT_LT(least[axis], 0.01) << axis;
    EXPECT_GT(most[axis], 0.99) << axis;
  }
}

TEST(JitteredGrid, EveryNumberIsStratified) {
  for (std::uint32_t count = 1; count <= 300; ++count) {
    const JitteredGrid grid(count);
    std::uint32_t left = 0, low = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto [x, y] = grid.point(i, 4);
      ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1) << count << " " << i;
      left += x < 0.5 ? 1 : 0;
      low += y < 0.5 ? 1 : 0;
    }
    // The line x = 1/2 crosses one cell of each row; y = 1/2 crosses the cells of one row.
    const double strata = std::sqrt(count) + 2;
    EXPECT_NEAR(left, 0.5 * count, strata) << count;
    EXPECT_NEAR(low, 0.5 * count, strata) << count;
  }
}

TEST(JitteredGrid, SeedsDiffer) {
  const JitteredGrid grid(16);
  EXPECT_EQ(grid.point(5, 1), grid.point(5, 1));
  EXPECT_NE(grid.point(5, 1), grid.point(5, 2));
}

TEST(LightPoint, RectFillsTheRect) {
  const Light light = light_at_origin(RectLight{4, 2});
  EXPECT_EQ(light_point(light, {0, 0}), glm::dvec3(-2, -1, 0));
  EXPECT_EQ(light_point(light, {0.5, 0.5}), glm::dvec3(0));
  EXPECT_EQ(light_point(light, {0.75, 0.25}), glm::dvec3(1, -0.5, 0));
}

TEST(LightSurface, GivesEachTexelItsShare) {
  Light light = light_at_origin(RectLight{2, 2});
  // Shares of columns and, within them, of texels are multiples of 1/16.
  light.emission = std::make_shared<const EmissionImage>(EmissionImage{3, 2, {2, 0, 1, 2, 0, 3}});
  const LightSurface surface(light);
  std::array<int, 6> count{};
  for (int i = 0; i < 256; ++i) {
    const glm::dvec3 p = surface.point({(i % 16 + 0.5) / 16, (static_cast<double>(i / 16) + 0.5) / 16});
    ASSERT_EQ(p.z, 0);
    const double u = (p.x + 1) / 2, v = (p.y + 1) / 2;
    ASSERT_TRUE(u >= 0 && u < 1 && v >= 0 && v < 1);
    ++count[(v < 0.5 ? 0U : 3U) + static_cast<std::size_t>(3 * u)];
  }
  EXPECT_EQ(count, (std::array<int, 6>{64, 0, 32, 64, 0, 96}));
}

TEST(LightSurface, OfADiskIsWhatOfItsPictureLiesOnIt) {
  Light light = light_at_origin(DiskLight{2});
  // Of the left half a quarter emits, and of that what is on the disk.
  light.emission = std::make_shared<const EmissionImage>(EmissionImage{2, 2, {0, 3, 1, 0}});
  const LightSurface surface(light);
  constexpr int kSide = 128;
  int left = 0, within = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::dvec3 p =
        surface.point({(i % kSide + 0.5) / kSide, (static_cast<double>(i / kSide) + 0.5) / kSide});
    ASSERT_TRUE(p.x <= 0 ? p.y >= 0 : p.y <= 0);
    ASSERT_LE(glm::length(p), 2);
    left += p.x <= 0 ? 1 : 0;
    within += glm::length(p) <= 1 ? 1 : 0;
  }
  // Shares 1/4 and 1/4. By Hoeffding, as if all points were drawn apart, but for one time in a million.
  const double tolerance = std::sqrt(std::log(2e6) / 2) * kSide;
  EXPECT_NEAR(left, kSide * kSide / 4, tolerance);
  EXPECT_NEAR(within, kSide * kSide / 4, tolerance);
}

TEST(LightPoint, DiskKeepsAreas) {
  // A grid of equal cells: the share of points within radius r is r^2, up to the cells that the circle cuts.
  constexpr std::uint32_t kSide = 256;
  const Light light = light_at_origin(DiskLight{1});
  for (const double radius : {0.25, 0.5, 0.9, 1.0}) {
    std::uint32_t inside = 0, right = 0;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const auto p =
          light_point(light, {(i % kSide + 0.5) / kSide, (static_cast<double>(i / kSide) + 0.5) / kSide});
      inside += std::hypot(p[0], p[1]) <= radius ? 1 : 0;
      right += p[0] > 0.5 ? 1 : 0;
    }
    EXPECT_NEAR(inside, radius * radius * kSide * kSide, 4 * kSide) << radius;
    EXPECT_NEAR(right, 0.195501 * kSide * kSide, 4 * kSide);  // (acos(1/2) - 1/2 sqrt(3/4)) / pi
  }
}

}  // namespace
}  // namespace pdsm
