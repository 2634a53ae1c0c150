// SPDX-License-Identifier: Apache-2.0
// What the lists of walk steps mean, against the geometry of the path itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "support/walk_case.h"
#include "walk/walk_steps.h"

namespace pdsm::test {
namespace {

constexpr int kCases = 4000;

RayPath random_path(Random& random, SamplePlane plane) {
  const MapGrid grid = random_grid(random);
  const LightSample sample = random_sample(random, grid, plane);
  return make_ray_path(grid, sample, random.count(0, grid.texels[0] - 1),
                       random.count(0, grid.texels[1] - 1));
}

/// Rounding of a step's depths: one float step (2^-24 relative) where z = origin_z + 1/w is rounded, and
/// as much again for the border's w, which double has to 2^-52.
double depth_rounding(const RayPath& path) {
  const double far = std::abs(path.origin_z) + 1 / path.w_end;
  return 0x1.0p-23 * far;
}

/// Depths between which the path is in the closed square of a texel, by clipping; nothing if it misses. A
/// path along a border belongs to the texel above it.
std::optional<std::array<double, 2>> clip_to_texel(const RayPath& path, std::int32_t dx, std::int32_t dy) {
  double low = path.w_end, high = path.w_begin;
  const std::array<std::int32_t, 2> texel{dx, dy};
  for (std::size_t a = 0; a < 2; ++a) {
    const double slope = path.slope[a];
    const double t0 = texel[a] - path.fraction[a], t1 = t0 + 1;
    if (slope == 0) {
      if (t0 > 0 || t1 <= 0) return std::nullopt;
      continue;
    }
    low = std::max(low, std::min(t0 / slope, t1 / slope));
    high = std::min(high, std::max(t0 / slope, t1 / slope));
  }
  if (!(low < high)) return std::nullopt;
  return std::array<double, 2>{path.origin_z + 1 / high, path.origin_z + 1 / low};
}

class WalkSteps : public testing::TestWithParam<Walk> {};

TEST_P(WalkSteps, TileNearToFarWithoutGaps) {
  Random random(1);
  std::vector<WalkStep> steps;
  for (int n = 0; n < kCases; ++n) {
    const RayPath path = random_path(random, n % 2 == 0 ? SamplePlane::planar : SamplePlane::tilted);
    list_walk_steps(path, GetParam(), steps);
    ASSERT_FALSE(steps.empty()) << "case " << n;
    EXPECT_EQ(steps.front().begin, path.depth(path.w_begin)) << "case " << n;
    EXPECT_EQ(steps.back().end, path.depth(path.w_end)) << "case " << n;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      ASSERT_LT(steps[s].begin, steps[s].end) << "case " << n;
      ASSERT_EQ(steps[s].begin, s == 0 ? steps[0].begin : steps[s - 1].end) << "case " << n;
    }
  }
}

/// Whether the path meets a border exactly where a walk decides: at its start, or in the middle of a column.
bool decides_on_border(const RayPath& path, const std::vector<WalkStep>& steps) {
  const std::size_t major = std::abs(path.slope[0]) >= std::abs(path.slope[1]) ? 0 : 1, minor = 1 - major;
  const double share = path.slope[major] == 0 ? 0 : path.slope[minor] / path.slope[major];
  return path.fraction[0] == 0 || path.fraction[1] == 0 ||
         std::any_of(steps.begin(), steps.end(), [&](const WalkStep& step) {
           const double run = (major == 0 ? step.dx : step.dy) + 0.5 - path.fraction[major];
           const double across = path.fraction[minor] + run * share;
           return across == std::floor(across);
         });
}

/// The walk of a mirrored path: the same depths, mirrored texels. A border belongs to the texel above it on
/// either side of the mirror, so paths that meet one exactly are left out.
TEST_P(WalkSteps, MirroredPathGivesMirroredWalk) {
  Random random(2);
  std::vector<WalkStep> steps, mirrored;
  int compared = 0;
  for (int n = 0; n < kCases; ++n) {
    const RayPath path = random_path(random, SamplePlane::planar);
    list_walk_steps(path, GetParam(), steps);
    if (decides_on_border(path, steps)) continue;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      RayPath mirror = path;
      mirror.fraction[axis] = 1 - path.fraction[axis];
      mirror.base[axis] = -path.base[axis] - 1;
      mirror.slope[axis] = -path.slope[axis];
      list_walk_steps(mirror, GetParam(), mirrored);
      for (WalkStep& step : mirrored) (axis == 0 ? step.dx : step.dy) *= -1;
      ASSERT_EQ(steps, mirrored) << "case " << n << ", axis " << axis;
      ++compared;
    }
  }
  EXPECT_GT(compared, kCases);
}

TEST_P(WalkSteps, ExchangedAxesGiveTheExchangedWalk) {
  Random random(3);
  std::vector<WalkStep> steps, exchanged;
  for (int n = 0; n < kCases; ++n) {
    const RayPath path = random_path(random, SamplePlane::planar);
    // At 45 degrees x is the major axis on both sides of the exchange.
    if (std::abs(path.slope[0]) == std::abs(path.slope[1])) continue;
    RayPath other = path;
    std::swap(other.fraction[0], other.fraction[1]);
    std::swap(other.slope[0], other.slope[1]);
    list_walk_steps(path, GetParam(), steps);
    list_walk_steps(other, GetParam(), exchanged);
    for (WalkStep& step : exchanged) std::swap(step.dx, step.dy);
    ASSERT_EQ(steps, exchanged) << "case " << n;
  }
}

TEST_P(WalkSteps, ARayWithinOneTexelIsAWalkOfLengthOne) {
  std::vector<WalkStep> steps;
  RayPath still;
  still.fraction = {0.25, 0.75};
  still.w_begin = 1;
  still.w_end = 0.1;
  for (const double drift : {0.0, 0.2, -0.2}) {
    still.slope = {drift, -drift};
    list_walk_steps(still, GetParam(), steps);
    const std::vector<WalkStep> expected{{0, 0, 1.0F, 10.0F}};
    EXPECT_EQ(steps, expected) << "drift " << drift;
  }
  // The sample at the light's centre: its rays never leave their texel, whatever the grid.
  Random random(4);
  for (int n = 0; n < 200; ++n) {
    const MapGrid grid = random_grid(random);
    const RayPath path = make_ray_path(grid, {{0, 0, 0}, {0.125F, -0.25F}, 1}, 0, 0);
    list_walk_steps(path, GetParam(), steps);
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_EQ(steps[0].dx, 0);
    EXPECT_EQ(steps[0].dy, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(BothWalks, WalkSteps, testing::Values(Walk::midpoint, Walk::exact),
                         [](const auto& walk) { return walk.param == Walk::exact ? "Exact" : "Midpoint"; });

/// Each texel near the path is clipped by itself: it is visited if the path crosses its closed square, at
/// the depths at which it does. A crossing within the rounding of a depth may be left out.
TEST(ExactWalk, VisitsExactlyTheTexelsThatThePathCrosses) {
  Random random(5);
  std::vector<WalkStep> steps;
  for (int n = 0; n < kCases; ++n) {
    const RayPath path = random_path(random, n % 2 == 0 ? SamplePlane::planar : SamplePlane::tilted);
    list_walk_steps(path, Walk::exact, steps);
    const double rounding = depth_rounding(path);
    std::array<std::int32_t, 4> box{0, 0, 0, 0};
    for (std::size_t a = 0; a < 2; ++a) {
      const double g0 = path.fraction[a] + path.slope[a] * path.w_begin,
                   g1 = path.fraction[a] + path.slope[a] * path.w_end;
      box[a] = static_cast<std::int32_t>(std::floor(std::min(g0, g1))) - 1;
      box[a + 2] = static_cast<std::int32_t>(std::floor(std::max(g0, g1))) + 1;
    }
    for (std::int32_t y = box[1]; y <= box[3]; ++y) {
      for (std::int32_t x = box[0]; x <= box[2]; ++x) {
        const auto span = clip_to_texel(path, x, y);
        const auto step = std::find_if(steps.begin(), steps.end(),
                                       [&](const WalkStep& s) { return s.dx == x && s.dy == y; });
        if (step == steps.end()) {
          ASSERT_TRUE(!span || (*span)[1] - (*span)[0] <= rounding)
              << "case " << n << " misses " << x << ", " << y;
          continue;
        }
        ASSERT_TRUE(span) << "case " << n << " visits " << x << ", " << y;
        ASSERT_NEAR(step->begin, (*span)[0], rounding) << "case " << n;
        ASSERT_NEAR(step->end, (*span)[1], rounding) << "case " << n;
      }
    }
    for (const WalkStep& step : steps) {
      ASSERT_TRUE(step.dx >= box[0] && step.dx <= box[2] && step.dy >= box[1] && step.dy <= box[3])
          << "case " << n;
    }
  }
}

/// One texel a column, in order; its centre is at most half a texel from the path in the middle of the
/// column (2^-40: the rounding of that path's evaluation, some 2^-52 of up to 2^8 texels).
TEST(MidpointWalk, VisitsTheNearestCentreOfEachColumn) {
  Random random(6);
  std::vector<WalkStep> steps;
  for (int n = 0; n < kCases; ++n) {
    const RayPath path = random_path(random, n % 2 == 0 ? SamplePlane::planar : SamplePlane::tilted);
    list_walk_steps(path, Walk::midpoint, steps);
    const bool x_major = std::abs(path.slope[0]) >= std::abs(path.slope[1]);
    const std::size_t major = x_major ? 0 : 1, minor = 1 - major;
    const double rounding = depth_rounding(path);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const std::int32_t column = x_major ? steps[s].dx : steps[s].dy,
                         row = x_major ? steps[s].dy : steps[s].dx;
      if (s > 0) {
        const std::int32_t before = x_major ? steps[s - 1].dx : steps[s - 1].dy;
        ASSERT_EQ(column - before, path.slope[major] < 0 ? 1 : -1) << "case " << n;
      }
      const double share = path.slope[major] == 0 ? 0 : path.slope[minor] / path.slope[major];
      const double at_middle = path.fraction[minor] + (column + 0.5 - path.fraction[major]) * share;
      ASSERT_LE(std::abs(row + 0.5 - at_middle), 0.5 + 0x1.0p-40) << "case " << n;
      // The step's depths are those of the whole column.
      RayPath flat = path;
      flat.slope[minor] = 0;
      flat.fraction[minor] = 0.5;
      const auto span = x_major ? clip_to_texel(flat, column, 0) : clip_to_texel(flat, 0, column);
      ASSERT_TRUE(span) << "case " << n;
      ASSERT_NEAR(steps[s].begin, (*span)[0], rounding) << "case " << n;
      ASSERT_NEAR(steps[s].end, (*span)[1], rounding) << "case " << n;
    }
  }
}

/// The law a(z) of design.md section 3, evaluated as it is written there: g differs from it by at most the
/// rounding to 2^-24 texel and that of double.
TEST(RayPath, FollowsTheShiftLaw) {
  Random random(7);
  for (int n = 0; n < kCases; ++n) {
    const MapGrid grid = random_grid(random);
    const LightSample sample =
        random_sample(random, grid, n % 2 == 0 ? SamplePlane::planar : SamplePlane::tilted);
    const std::array<std::uint32_t, 2> index{random.count(0, grid.texels[0] - 1),
                                             random.count(0, grid.texels[1] - 1)};
    const RayPath path = make_ray_path(grid, sample, index[0], index[1]);
    const double s_z = sample.position[2], focus = grid.focus_depth;
    for (const double z : {grid.near_depth, focus, grid.far_depth}) {
      for (std::size_t a = 0; a < 2; ++a) {
        const double u =
            grid.origin[a] + (index[a] + 0.5) * grid.pitch[a] * grid.ratio[a].fine / grid.ratio[a].coarse;
        // Where the line from the sample to the point meets the focus plane.
        const double s = sample.position[a], point = z * u;
        const double on_focus = (s + (point - s) * (focus - s_z) / (z - s_z)) / focus;
        const double expected = (on_focus - grid.origin[a]) / grid.pitch[a] - sample.jitter[a];
        const double actual =
            static_cast<double>(path.base[a]) + path.fraction[a] + path.slope[a] / (z - s_z);
        // Two roundings to 2^-24 (each off by half); terms of up to 2^13 texels in double.
        ASSERT_NEAR(actual, expected, 0x1.0p-24 + 0x1.0p-36) << "case " << n << ", z " << z;
      }
    }
  }
}

/// The same for the parallel rays of a distant light.
TEST(RayPath, FollowsTheShiftLawUnderADistantLight) {
  Random random(8);
  for (int n = 0; n < kCases; ++n) {
    const MapGrid grid = random_grid(random, SamplePlane::distant);
    const LightSample sample = random_sample(random, grid, SamplePlane::distant);
    const std::array<std::uint32_t, 2> index{random.count(0, grid.texels[0] - 1),
                                             random.count(0, grid.texels[1] - 1)};
    const RayPath path = make_ray_path(grid, sample, index[0], index[1]);
    EXPECT_EQ(path.depth(path.w_begin), static_cast<float>(grid.near_depth));
    EXPECT_EQ(path.depth(path.w_end), static_cast<float>(grid.far_depth));
    for (const double z : {grid.near_depth, grid.focus_depth, grid.far_depth}) {
      for (std::size_t a = 0; a < 2; ++a) {
        const double place =
            grid.origin[a] + (index[a] + 0.5) * grid.pitch[a] * grid.ratio[a].fine / grid.ratio[a].coarse;
        const double on_focus = place + sample.position[a] * (grid.focus_depth - z);
        const double expected = (on_focus - grid.origin[a]) / grid.pitch[a] - sample.jitter[a];
        const double actual =
            static_cast<double>(path.base[a]) + path.fraction[a] + path.slope[a] * (grid.focus_depth - z);
        ASSERT_NEAR(actual, expected, 0x1.0p-24 + 0x1.0p-36) << "case " << n << ", z " << z;
      }
    }
  }
}

TEST(MapGrid, RatiosRoundToTheNearestThatOneListServes) {
  const auto ratio = [](std::uint32_t map, std::uint32_t texels) {
    const GridRatio r = round_ratio(map, texels);
    return std::pair(r.fine, r.coarse);
  };
  EXPECT_EQ(ratio(512, 512), std::pair(1u, 1u));
  EXPECT_EQ(ratio(1536, 512), std::pair(3u, 1u));
  EXPECT_EQ(ratio(1250, 512), std::pair(2u, 1u));
  EXPECT_EQ(ratio(1290, 512), std::pair(3u, 1u));
  EXPECT_EQ(ratio(146, 512), std::pair(1u, 4u));
  EXPECT_EQ(ratio(128, 512), std::pair(1u, 4u));
  EXPECT_EQ(ratio(150, 512), std::pair(1u, 3u));
  EXPECT_EQ(ratio(511, 512), std::pair(1u, 1u));
  EXPECT_EQ(ratio(1, 7), std::pair(1u, 7u));
}

}  // namespace
}  // namespace pdsm::test
