// SPDX-License-Identifier: Apache-2.0
// What a window sees of a light, against lines from the light to points that the window sees.
#include "light/light_spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

constexpr int kCases = 2000;
constexpr double kDeepest = 9, kRounding = 1e-12;
constexpr Window kWindow{-0.4, -0.3, 0.7, 0.2};

/// A line from the light to a point that kWindow sees: `from` in z = 0.
struct LightLine {
  glm::dvec3 from{0}, to{0};
};

LightLine random_line(Random& random, const Light& light, const std::array<double, 2>& half) {
  const double z = random.uniform(1, kDeepest), spread = is_distant(light) ? 1 : z;
  const glm::dvec3 to(random.uniform(kWindow[0], kWindow[2]) * spread,
                      random.uniform(kWindow[1], kWindow[3]) * spread, z);
  const double x = random.uniform(-half[0], half[0]), y = random.uniform(-half[1], half[1]);
  return {is_distant(light) ? to - z * glm::dvec3(x, y, 1) : glm::dvec3(x, y, 0), to};
}

class Spread : public testing::TestWithParam<bool> {
 protected:
  Light light_ = GetParam() ? distant_light(50) : rect_light(2, 1);
  LightSpread spread_{light_};
  std::array<double, 2> half_ = half_extents(light_);
};

TEST_P(Spread, HoldsWhatTheLightMeetsOnItsWay) {
  Random random(91);
  const ConvexRegion hull = spread_.hull(kWindow, kDeepest), pyramid = spread_.pyramid(kWindow);
  const auto corners = spread_.corners(kWindow, kDeepest);
  for (int n = 0; n < kCases; ++n) {
    const LightLine line = random_line(random, light_, half_);
    EXPECT_EQ(pyramid.outside_bits(line.to), 0U);
    const glm::dvec3 caster = line.from + random.uniform(0.05, 1) * (line.to - line.from);
    for (const HalfSpace& side : hull.half_spaces()) EXPECT_GE(side.distance(caster), -kRounding);
    const Window shadow = spread_.shadow(caster, kDeepest);
    const auto [x, y] = spread_.place(line.to);
    EXPECT_TRUE(x >= shadow[0] - kRounding && x <= shadow[2] + kRounding) << n;
    EXPECT_TRUE(y >= shadow[1] - kRounding && y <= shadow[3] + kRounding) << n;
    EXPECT_GE(line.from.x, corners[0].x - kRounding);
    EXPECT_GE(line.from.y, corners[0].y - kRounding);
    EXPECT_LE(line.from.x, corners[2].x + kRounding);
    EXPECT_LE(line.from.y, corners[2].y + kRounding);
  }
}

TEST_P(Spread, FrontsAreWhatSomeOfTheLightReaches) {
  Random random(92);
  int front = 0, back = 0;
  for (int n = 0; n < kCases; ++n) {
    const LightLine line = random_line(random, light_, half_);
    const auto offset = [&] {
      return glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    std::array<glm::dvec3, 3> triangle{line.to, line.to + offset(), line.to + offset()};
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    if (glm::dot(normal, line.from - line.to) > 0) {
      EXPECT_TRUE(spread_.reaches_front(triangle)) << n;
      ++front;
    }
    // A plane that the light is on one side of shows it one side.
    std::swap(triangle[1], triangle[2]);
    if (!spread_.reaches_front(triangle)) {
      EXPECT_GT(glm::dot(normal, line.from - line.to), 0) << n;
      ++back;
    }
  }
  EXPECT_GT(front, kCases / 4);
  EXPECT_GT(back, kCases / 8);
}

INSTANTIATE_TEST_SUITE_P(BothKinds, Spread, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Distant" : "Planar"; });

}  // namespace
}  // namespace pdsm::test
