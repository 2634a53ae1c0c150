// SPDX-License-Identifier: Apache-2.0
// Distant lights: windows, samples, bias, what is left out and what is refused. Their shadows in closed form:
// distant_light_truth_test.cpp.
#include <gtest/gtest.h>

#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/exact_truth.h"

namespace pdsm::test {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;
constexpr double kOccluder = 3, kFar = 8;

TEST(DistantLight, WithoutAnAngleMakesHardShadows) {
  Light light = distant_light(0);
  light.window = {-2, -2, 2, 2};
  light.near_depth = 2;
  light.far_depth = kFar;
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, kOccluder}, Roles::caster);
  add(scene, Plate{-9, -9, 9, 9, kFar}, Roles::receiver);
  BakeOptions options = small_options(40, 40, 32);
  options.map_width = options.map_height = 160;
  const BakedFunctions baked(scene, light, options);
  const double border = texel_reach(Walk::exact) * baked.map_pitch_x();
  int dark = 0, lit = 0;
  for (std::uint32_t j = 0; j < 40; ++j) {
    for (std::uint32_t i = 0; i < 40; ++i) {
      const double out = std::max(std::abs(baked.slope_x(i)), std::abs(baked.slope_y(j))) - 1;
      if (std::abs(out) <= border) continue;
      EXPECT_EQ(baked.value(i, j, 7.9), out < 0 ? 1 : 0) << i << ", " << j;
      ++(out < 0 ? dark : lit);
    }
  }
  EXPECT_EQ(dark, 400);
  EXPECT_EQ(lit, 1200);
}

TEST(DistantLight, OneSampleStandsForItsCentre) {
  const auto samples = make_light_samples(distant_light(30), 1, PointSet::lattice, 0);
  EXPECT_EQ(samples[0].position, (std::array<double, 3>{0, 0, 1}));
}

TEST(DistantLight, CastersBeforeAGivenNearCount) {
  Light light = distant_light(5);
  light.window = {-0.5, -0.5, 0.5, 0.5};
  light.near_depth = 4;
  Scene scene;
  add(scene, Plate{-3, -3, 3, 3, 1e-3}, Roles::caster);
  add(scene, Plate{-9, -9, 9, 9, kFar}, Roles::receiver);
  const BakedFunctions baked(scene, light, small_options(8, 8, 16));
  EXPECT_EQ(baked.value(4, 4, 7.9), 1);
}

/// A floor that hides the sun below it darkens what stands on it; one that the rays run along, nothing.
TEST(DistantLight, MayShineFromBelowOrAlongTheFloor) {
  Scene scene;
  add(scene, quad_mesh({-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5}));
  add(scene, box_mesh({-1, 1, -1}, {1, 2, 1}));
  for (const double height : {1.0, 0.0, -1.0}) {
    Light light = distant_light(0.53);
    light.direction = {1, height, 0};
    light.up.reset();
    place_distant_light(scene, light);
    BakeOptions options = small_options(64, 64, 32);
    options.receivers = Receivers::all;
    const BakedFunctions baked(scene, light, options);
    // Upstream and downstream of the box, at half its height.
    const auto value_at = [&](const glm::dvec3& world) {
      const glm::dvec3 p = apply(baked.view().world_to_view, world);
      const auto& w = baked.view().window;
      const double i = (p.x - w[0]) / (w[2] - w[0]) * 64, j = (p.y - w[1]) / (w[3] - w[1]) * 64;
      if (i < 0 || i >= 64 || j < 0 || j >= 64) return 0.0;
      return baked.value(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), p.z);
    };
    EXPECT_EQ(value_at({-1.5, 1.5, 0}), height > 0 ? 1 : 0) << height;
    EXPECT_EQ(value_at({1.5, height < 0 ? 0.5 : 1.5, 0}), 1) << height;
  }
}

TEST(DistantLight, GivesTheSameBytesForAnyThreadsAndTiles) {
  Scene scene;
  add(scene, sphere_mesh({0.3, -0.4, 4}, 0.7, 4));
  add(scene, Plate{-1.5, -1.2, 0.1, 0.6, 3});
  add(scene, Plate{-9, -9, 9, 9, 8});
  Light light = distant_light(12);
  light.direction = {0.5, 0.2, 1};
  place_distant_light(scene, light);
  for (const std::uint32_t map : {150U, 300U, 50U}) {
    BakeOptions options = small_options(150, 150, 12);
    options.map_width = options.map_height = map;
    options.mip_levels = 3;
    const BakedFunctions first(scene, light, options);
    EXPECT_GT(first.vertex_count(), 1000U);
    for (const auto& [threads, tile] : {std::pair(1U, 64U), {2U, 0U}, {3U, 128U}, {3U, 64U}}) {
      options.threads = threads;
      options.tile = tile;
      expect_same_bytes(first, {scene, light, options});
    }
  }
}

/// Rays that nothing can darken are left out, and only these: all others have the functions that an oracle
/// without maps tells.
TEST(DistantLight, LeavesOutOnlyRaysThatNothingCanDarken) {
  Scene scene;
  add(scene, Plate{-0.4, -0.4, 0.4, 0.4, 2}, Roles::caster);
  add(scene, quad_mesh({-6, -6, 5}, {6, -6, 11}, {6, 6, 11}, {-6, 6, 5}));
  Light light = distant_light(30);
  light.window = {-5, -5, 5, 5};
  BakeOptions options = small_options(200, 200, 64);
  options.epsilon = 0;
  const BakedFunctions baked(scene, light, options);
  std::uint64_t walks = 0;
  for (const ModelledFeature& feature : baked.report().modelled)
    if (feature.feature == "rays that nothing can darken") walks = std::stoull(feature.saved);
  EXPECT_GT(walks, 200U * 200 * 64 / 4);
  // The oracle: each sample's line through the texel's point, in double, but where it passes within a texel
  // of the plate's border.
  for (std::uint32_t j = 0; j < 200; j += 3) {
    for (std::uint32_t i = 0; i < 200; i += 3) {
      const double x = baked.slope_x(i), y = baked.slope_y(j), z = 8 + 0.5 * x - 0.05;
      std::uint32_t certain = 0, possible = 0;
      for (const LightSample& sample : baked.map().samples) {
        const double out =
            std::max(std::abs(x - sample.position[0] * (z - 2)), std::abs(y - sample.position[1] * (z - 2))) -
            0.4;
        certain += out < -baked.map_pitch_x();
        possible += out < baked.map_pitch_x();
      }
      const auto count = static_cast<std::uint32_t>(std::lround(baked.value(i, j, z) * 64));
      EXPECT_GE(count, certain) << i << ", " << j;
      EXPECT_LE(count, possible) << i << ", " << j;
    }
  }
}

/// The default bias is a quarter of a map texel in metres, at any depth.
TEST(DistantLight, HasABiasOfAQuarterOfAMapTexel) {
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, kOccluder}, Roles::caster);
  add(scene, Plate{-9, -9, 9, 9, kFar});
  Light light = distant_light(2);
  light.window = {-2, -1, 2, 1};
  const BakedFunctions baked(scene, light, small_options(40, 40, 4));
  EXPECT_NEAR(baked.report().bias, 0.25 * 0.1, 1e-12);
}

/// For the scene's surfaces alone, functions stay in their tube wherever look-ups at a surface ask them:
/// within a texel of their ray, where a slope of 2 lies up to two pitches before it.
TEST(DistantLight, SurfacesAloneKeepTheirTube) {
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, 2}, Roles::caster);
  add(scene, quad_mesh({-3, -3, 2.5}, {3, -3, 14.5}, {3, 3, 14.5}, {-3, 3, 2.5}), Roles::receiver);
  add(scene, quad_mesh({-3, -3, 2.38}, {3, -3, 14.38}, {3, 3, 14.38}, {-3, 3, 2.38}), Roles::caster);
  Light light = distant_light(20);
  light.window = {-2.5, -2.5, 2.5, 2.5};
  BakeOptions options = small_options(40, 40, 64);
  options.epsilon = 0;
  const BakedFunctions exact(scene, light, options);
  options.epsilon = 0.02;
  options.receivers = Receivers::surfaces;
  const BakedFunctions baked(scene, light, options);
  ASSERT_LT(baked.vertex_count(), exact.vertex_count());
  // The exact one is so to within delta, too.
  const double delta = 2 * baked.report().depth_tolerance, rise = 2 * 5.0 / 40;
  for (std::uint32_t j = 0; j < 40; ++j) {
    for (std::uint32_t i = 0; i < 40; ++i) {
      for (const double share : {-0.9, -0.5, -0.4}) {
        const double z = 8.5 + 2 * exact.slope_x(i) + share * rise;
        double low = 1, high = 0;
        for (int n = -16; n <= 16; ++n) {
          low = std::min(low, exact.value(i, j, z + n / 16.0 * delta));
          high = std::max(high, exact.value(i, j, z + n / 16.0 * delta));
        }
        // Between two of these depths an event or two may pass unseen.
        ASSERT_GE(baked.value(i, j, z), low - 0.02 - 2.0 / 64) << i << ", " << j;
        ASSERT_LE(baked.value(i, j, z), high + 0.02 + 2.0 / 64) << i << ", " << j;
      }
    }
  }
}

struct Tilt {
  double degrees;
  Walk walk;
};

class TiltedPlane : public testing::TestWithParam<Tilt> {};

/// A plane that the whole sun shines on is lit at any tilt, whatever the maps: the sun's rays are within 5
/// degrees of the axis.
TEST_P(TiltedPlane, HoldsNoShadowOfItsOwn) {
  const double slope = std::tan(GetParam().degrees * kDegrees);
  Light light = distant_light(10);
  light.window = {-0.02, -0.02, 0.02, 0.02};
  light.near_depth = 5;
  light.far_depth = 12;
  Scene scene;
  add(scene, quad_mesh({-0.1, -0.1, 8 - 0.1 * slope}, {0.1, -0.1, 8 + 0.1 * slope},
                       {0.1, 0.1, 8 + 0.1 * slope}, {-0.1, 0.1, 8 - 0.1 * slope}));
  for (const double ratio : {1.0, 3.0, 0.5}) {
    BakeOptions options = small_options(24, 24, 25);
    options.map_width = options.map_height = static_cast<std::uint32_t>(24 * ratio);
    options.walk = GetParam().walk;
    options.bias = 1e-9;
    options.receivers = Receivers::all;
    const BakedFunctions baked(scene, light, options);
    for (std::uint32_t j = 0; j < 24; ++j)
      for (std::uint32_t i = 0; i < 24; ++i)
        ASSERT_EQ(baked.value(i, j, 8 + slope * baked.slope_x(i)), 0) << i << ", " << j << ", " << ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryTilt, TiltedPlane,
                         testing::Values(Tilt{0, Walk::exact}, Tilt{40, Walk::midpoint},
                                         Tilt{40, Walk::exact}, Tilt{80, Walk::exact},
                                         Tilt{80, Walk::midpoint}),
                         [](const auto& tilt) { return "Case" + std::to_string(tilt.index); });

TEST(DistantLight, RefusesWhatItCannotBake) {
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, kOccluder});
  add(scene, Plate{-9, -9, 9, 9, kFar});
  const auto fault = [&](const Light& light, const BakeOptions& options) -> std::string {
    try {
      (void)bake(scene, light, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const BakeOptions options = small_options(8, 8, 4);
  for (const double angle : {-1.0, 90.1, std::nan("")})
    EXPECT_EQ(fault(distant_light(angle), options), "test.angle: must be from 0 to 90 degrees") << angle;
  Light behind = distant_light(1);
  behind.position = {0, 0, 5};
  EXPECT_NE(fault(behind, options).find("test.position: a distant light's space must begin in front"),
            std::string::npos);
  place_distant_light(scene, behind);
  EXPECT_EQ(fault(behind, options), "");
  BakeOptions own = options;
  own.light_samples = {LightSample{}};
  EXPECT_NE(fault(distant_light(1), own).find("must be finite directions with z = 1"), std::string::npos);
  Light wide = distant_light(90);
  wide.window = {-1e-4, -1e-4, 1e-4, 1e-4};
  BakeOptions fine = options;
  fine.map_width = fine.map_height = 16 * 64;
  EXPECT_NE(fault(wide, fine).find("walks would cross"), std::string::npos);
}

}  // namespace
}  // namespace pdsm::test
