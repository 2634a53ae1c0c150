// SPDX-License-Identifier: Apache-2.0
// Bias: a lit plane is lit, whatever its slope and the maps; a plate casts from the bias on.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

constexpr double kCenter = 6;

/// A surface about (0.7, 0, 6) that is tilted about the y axis. Its plane passes beside the light, whose edge
/// is at x = 0.5, at any slope: the light is wholly before it.
constexpr double kSide = 0.7;

struct Slope {
  double degrees;
  bool closed;

  [[nodiscard]] double angle() const { return degrees * std::numbers::pi / 180; }
  /// Depth at which the ray of slope u meets the surface's plane (x - 0.7) sin + (z - 6) cos = 0.
  [[nodiscard]] double depth(double u) const {
    const double sine = std::sin(angle()), cosine = std::cos(angle());
    return (kSide * sine + kCenter * cosine) / (u * sine + cosine);
  }
  /// Slope of the ray to the surface's point at distance a from its centre.
  [[nodiscard]] double ray_to(double a) const {
    return (kSide + a * std::cos(angle())) / (kCenter - a * std::sin(angle()));
  }

  [[nodiscard]] Scene scene() const {
    Scene s;
    // 6 x 6, thin for an open mesh, 0.4 thick behind the lit side for a closed one.
    if (closed)
      add(s, box_mesh({-3, -3, 0}, {3, 3, 0.4}));
    else
      add(s, Plate{-3, -3, 3, 3, 0});
    s.geometry[0].local_to_world = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(kSide, 0, kCenter)),
                                               angle(), glm::dvec3(0, 1, 0));
    return s;
  }
};

struct SlopeCase {
  Slope slope;
  Walk walk;
};

class LitPlane : public testing::TestWithParam<SlopeCase> {};

/// Bias too small to be of use, the default, and a large one; maps finer than the PDSM, as fine, coarser.
TEST_P(LitPlane, HoldsNoShadow) {
  const auto [slope, walk] = GetParam();
  Light light = rect_light(1, 1);
  // The window that the surface fills, but for its borders.
  light.window = {slope.ray_to(-2.4), -0.25, slope.ray_to(2.4), 0.25};
  light.near_depth = 2;
  light.far_depth = 10;
  for (const std::optional<double> bias :
       {std::optional<double>(), std::optional<double>(1e-9), std::optional<double>(0.5)}) {
    for (const double ratio : {1.0, 3.0, 0.5, 0.25}) {
      for (const Receivers receivers : {Receivers::volume, Receivers::all}) {
        BakeOptions options = small_options(24, 16, 25);
        options.map_width = static_cast<std::uint32_t>(24 * ratio);
        options.map_height = static_cast<std::uint32_t>(16 * ratio);
        options.bias = bias;
        options.walk = walk;
        options.receivers = receivers;
        const BakedFunctions baked(slope.scene(), light, options);
        int on_surface = 0;
        for (std::uint32_t j = 0; j < 16; ++j) {
          for (std::uint32_t i = 0; i < 24; ++i) {
            const double z = slope.depth(baked.slope_x(i)), x = z * baked.slope_x(i),
                         y = z * baked.slope_y(j);
            // Where the ray meets the surface itself, not the plane around it.
            if (z <= 2 || z >= 10 || std::hypot(x - kSide, z - kCenter) > 2.8 || std::abs(y) > 2.8) continue;
            ++on_surface;
            ASSERT_EQ(baked.value(i, j, z), 0)
                << "texel " << i << ", " << j << ", ratio " << ratio << ", bias " << baked.report().bias;
            // By default the function ends there, and holds what it had: no shadow at any depth.
            ASSERT_TRUE(receivers == Receivers::all || baked.function(i, j).empty())
                << "texel " << i << ", " << j;
          }
        }
        EXPECT_GT(on_surface, 100) << "the window must hold the surface";
      }
    }
  }
}

std::vector<SlopeCase> slope_cases() {
  std::vector<SlopeCase> cases;
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9}) {
    for (const bool closed : {false, true}) {
      for (const Walk walk : {Walk::exact, Walk::midpoint}) cases.push_back({{degrees, closed}, walk});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(EverySlope, LitPlane, testing::ValuesIn(slope_cases()), [](const auto& test) {
  const SlopeCase& c = test.param;
  return "Deci" + std::to_string(std::lround(10 * c.slope.degrees)) + (c.slope.closed ? "Closed" : "Open") +
         (c.walk == Walk::exact ? "Exact" : "Midpoint");
});

class PlateGap : public testing::TestWithParam<Walk> {
 protected:
  /// V on the floor below a wide plate at gap g above it.
  [[nodiscard]] static BakedFunctions bake_gap(double gap, double epsilon, Receivers receivers) {
    Light light = rect_light(1, 1);
    set_view(light, 0.1, 0.1, 2, 8);
    Scene scene;
    add(scene, Plate{-2, -2, 2, 2, kCenter - gap}, Roles::caster);
    add(scene, Plate{-9, -9, 9, 9, kCenter}, Roles::both);
    BakeOptions options = small_options(4, 4, 30);
    options.bias = kBias;
    options.depth_tolerance = kDelta;
    options.epsilon = epsilon;
    options.walk = GetParam();
    options.receivers = receivers;
    return {scene, light, options};
  }

  static constexpr double kBias = 0.1, kDelta = 0.02;
};

/// q: the depth quantum, and 16 float steps at far for the traced depth.
TEST_P(PlateGap, CastsFromTheBiasOn) {
  for (const double epsilon : {0.0, 0.02}) {
    for (const Receivers receivers : {Receivers::volume, Receivers::all}) {
      const BakedFunctions probe = bake_gap(1, epsilon, receivers);
      const double quantum = depth_step(probe.view(), probe.map().coding) + 0x1.0p-20 * 8;
      const double least = kBias + kDelta + quantum, most = kBias - kDelta - quantum;
      for (const double gap : {least * 1.001, 0.2, 1.0}) {
        const BakedFunctions baked = bake_gap(gap, epsilon, receivers);
        for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(baked.value(i, 3 - i, kCenter), 1) << "gap " << gap;
      }
      for (const double gap : {most * 0.999, 0.05, 1e-3}) {
        const BakedFunctions baked = bake_gap(gap, epsilon, receivers);
        for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(baked.value(i, 3 - i, kCenter), 0) << "gap " << gap;
      }
    }
  }
}

/// A sheet that rises from depth 4 to 6 within a fraction of a texel, edge-on to a point light, `floors`
/// below.
class EdgeOnSheet : public testing::Test {
 protected:
  static constexpr double kPitch = 0.05, kFrom = 0.3, kTo = 0.7;  // of texel 2, along x

  [[nodiscard]] static BakedFunctions bake_over(const std::vector<Mesh>& below, Roles roles = Roles::both) {
    Light light = rect_light(0, 0);
    set_view(light, 2 * kPitch, 2 * kPitch, 2, 9);
    Scene scene;
    const auto corner = [](double share, double y, double z) { return glm::dvec3(share * kPitch * z, y, z); };
    add(scene, quad_mesh(corner(kFrom, -9, 4), corner(kTo, -9, 6), corner(kTo, 9, 6), corner(kFrom, 9, 4)));
    for (const Mesh& mesh : below) add(scene, mesh, roles);
    BakeOptions options = small_options(4, 4, kSamples);
    options.epsilon = 0;
    options.bias = kBias;
    return {scene, light, options};
  }

  static constexpr std::uint32_t kSamples = 64;
  static constexpr double kBias = 0.01;
};

TEST_F(EdgeOnSheet, DarkensTheFloorFromHalfWayOn) {
  // Maps meet the sheet at depths 4 .. 6 where their shifted texel centres fall on it: for a share of 0.4 of
  // the shifts. All begin half-way to the floor at 8: at 6 the first, at 7 the last.
  const BakedFunctions baked = bake_over({quad_mesh({-9, -9, 8}, {9, -9, 8}, {9, 9, 8}, {-9, 9, 8})});
  const double dark = baked.value(2, 1, 8);
  // The first 64 numbers of a golden-ratio sequence are in an interval as often as its length says, to 4.
  EXPECT_NEAR(dark, kTo - kFrom, 4.0 / kSamples);
  EXPECT_EQ(baked.value(2, 1, 6), 0);
  EXPECT_EQ(baked.value(2, 1, 7.0 + kBias + 0.01), dark);
}

TEST_F(EdgeOnSheet, AloneHasNoShadow) {
  EXPECT_EQ(bake_over({}).value(2, 1, 9), 0);
}

TEST_F(EdgeOnSheet, SurfacesThatFaceAwayHoldNothingBack) {
  // Within a closed box, what lies behind the sheet is the box's bottom, from inside.
  const Mesh around = box_mesh({-9, -9, 3.9}, {9, 9, 8});
  EXPECT_EQ(bake_over({around}, Roles::receiver).value(2, 1, 7.9), 0);
  // The same bottom, open, has a side that faces the light.
  const Mesh bottom = quad_mesh({-9, -9, 8}, {9, -9, 8}, {9, 9, 8}, {-9, 9, 8});
  EXPECT_GT(bake_over({bottom}, Roles::receiver).value(2, 1, 7.9), 0);
}

INSTANTIATE_TEST_SUITE_P(BothWalks, PlateGap, testing::Values(Walk::midpoint, Walk::exact),
                         [](const auto& walk) { return walk.param == Walk::exact ? "Exact" : "Midpoint"; });

}  // namespace
}  // namespace pdsm::test
