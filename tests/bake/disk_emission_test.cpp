// SPDX-License-Identifier: Apache-2.0
// Pictures of disk lights, which cover the disk's bounding square.
#include "light/disk_emission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pdsm/format/error.h"
#include "scene/scene_channels.h"
#include "support/baked_functions.h"
#include "support/exact_truth.h"
#include "support/half_plane_shadow.h"

namespace pdsm::test {
namespace {

constexpr double kOccluder = 3;

Light disk_with(EmissionImage image) {
  Light light = rect_light(1, 1);
  light.name = "lamp";
  light.shape = DiskLight{1};
  light.emission = std::make_shared<const EmissionImage>(std::move(image));
  return light;
}

EmissionImage white(std::uint32_t width, std::uint32_t height) {
  return {width, height, std::vector<float>(std::size_t{width} * height, 1)};
}

TEST(DiskEmission, SharesAreAreas) {
  for (const auto& [width, height] : {std::pair{1U, 1U}, {2U, 2U}, {3U, 5U}, {16U, 9U}}) {
    const Light light = disk_with(white(width, height));
    double sum = 0;
    for (std::uint32_t row = 0; row < height; ++row)
      for (std::uint32_t column = 0; column < width; ++column) sum += share_on_light(light, column, row);
    EXPECT_NEAR(sum / (width * height), std::numbers::pi / 4, 1e-14) << width << " x " << height;
  }
  // The rightmost of four columns and the two rows above the axis: x from 1/2, y from 0 to 1.
  const double segment = (std::numbers::pi / 3 - std::sqrt(3) / 4) / 2;
  EXPECT_NEAR(share_on_light(disk_with(white(4, 2)), 3, 1), segment / 0.5, 1e-14);
  EXPECT_EQ(share_on_light(disk_with(white(8, 8)), 0, 0), 0);
  EXPECT_NEAR(share_on_light(disk_with(white(8, 8)), 3, 3), 1, 1e-14);
  Light rect = disk_with(white(8, 8));
  rect.shape = RectLight{};
  EXPECT_EQ(share_on_light(rect, 0, 0), 1);
}

TEST(DiskEmission, PointsLieWhereItEmitsAndInItsShares) {
  const EmissionImage image{5, 4, {9, 1, 0, 2, 9, 0, 3, 0, 0, 1, 1, 0, 5, 0, 0, 9, 0, 0, 4, 9}};
  const Light light = disk_with(image);
  const DiskEmissionWarp warp(image);
  constexpr int kSide = 512;
  std::vector<double> count(20), share(20);
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto [x, y] = warp({(i % kSide + 0.5) / kSide, (static_cast<double>(i / kSide) + 0.5) / kSide});
    ASSERT_LE(std::hypot(x, y), 1 + 1e-12);
    const auto column = static_cast<std::size_t>(std::min(4.0, (x + 1) / 2 * 5));
    const auto row = static_cast<std::size_t>(std::min(3.0, (y + 1) / 2 * 4));
    ++count[row * 5 + column];
  }
  double all = 0;
  for (std::uint32_t n = 0; n < 20; ++n)
    all += share[n] = static_cast<double>(image.luminance[n]) * share_on_light(light, n % 5, n / 5);
  // In the square a texel is bounded by two rows and by two curves that rise in each row: of 4 kSide cells a
  // point may be on the wrong side.
  for (std::size_t n = 0; n < 20; ++n)
    EXPECT_NEAR(count[n] / (kSide * kSide), share[n] / all, 4.0 / kSide) << n;
  EXPECT_EQ(count[2], 0);
}

TEST(DiskEmission, UniformPicturesAreNone) {
  // Of every strip along an axis, its area.
  for (const EmissionImage& image : {white(1, 1), white(7, 6)}) {
    const DiskEmissionWarp warp(image);
    constexpr int kSide = 128;
    for (const double edge : {-0.8, -0.1, 0.35, 0.9}) {
      int beyond_x = 0, beyond_y = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const auto [x, y] = warp({(i % kSide + 0.5) / kSide, (static_cast<double>(i / kSide) + 0.5) / kSide});
        beyond_x += x > edge ? 1 : 0;
        beyond_y += y > edge ? 1 : 0;
      }
      EXPECT_NEAR(beyond_x, disk_half_plane(1, edge) * kSide * kSide, kSide);
      EXPECT_NEAR(beyond_y, disk_half_plane(1, edge) * kSide * kSide, kSide);
    }
  }
}

TEST(DiskEmission, EndsOfTheSquareAreWhereItEmits) {
  // Lit are a texel that the rim cuts, above, and one below that reaches the axis.
  const DiskEmissionWarp warp({3, 3, {0, 0, 0, 1, 0, 0, 0, 0, 1}});
  const double last = 1 - std::numeric_limits<double>::epsilon() / 2;
  for (const double u : {0.0, 0.5, last})
    for (const double v : {0.0, 0.3, 0.7, last}) {
      const auto [x, y] = warp({u, v});
      EXPECT_LE(std::hypot(x, y), 1 + 1e-12) << u << " " << v;
      const double third = 1.0 / 3, tiny = 1e-12;
      const bool in_row = std::abs(y) <= third + tiny && x <= -third + tiny;
      const bool above = y >= third - tiny && x >= third - tiny;
      EXPECT_TRUE(in_row || above) << u << " " << v << ": " << x << ", " << y;
    }
}

TEST(DiskEmission, TwoHalvesBehindAnEdge) {
  constexpr double kLeft = 1, kRight = 3;
  // In the square that is warped the edge is a curve that turns back at most once a half.
  expect_half_plane_shadow(
      disk_with({2, 1, {kLeft, kRight}}), outline_strata(256), [](double edge, double slope, double depth) {
        const double beyond = disk_half_plane(1, back_project(edge, kOccluder, slope, depth));
        return 2 * (kRight * std::min(beyond, 0.5) + kLeft * std::max(beyond - 0.5, 0.0)) / (kLeft + kRight);
      });
}

TEST(DiskEmission, WhatLiesBesideTheDiskHasNoColour) {
  EmissionImage image = white(8, 8);
  image.colour.assign(64, glm::vec3(1));
  image.colour[0] = glm::vec3(1, 0, 0);
  EXPECT_FALSE(is_coloured(disk_with(image)));
  image.colour[3 * 8 + 3] = glm::vec3(1, 0, 0);
  EXPECT_TRUE(is_coloured(disk_with(image)));
}

TEST(DiskEmission, RefusesWhatIsBlackOnTheDisk) {
  EmissionImage image{8, 8, std::vector<float>(64, 0)};
  image.luminance[7] = 1;
  EXPECT_THROW(
      try { check_emission(disk_with(image)); } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "lamp.emission: is black on the disk");
        throw;
      },
      Error);
  image.luminance[3 * 8 + 4] = 1;
  EXPECT_NO_THROW(check_emission(disk_with(image)));
}

}  // namespace
}  // namespace pdsm::test
