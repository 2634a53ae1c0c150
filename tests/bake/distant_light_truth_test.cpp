// SPDX-License-Identifier: Apache-2.0
// Distant lights: shadows that are known in closed form, at the texels' own rays.
//
// A point at depth z sees the edge x = a of an occluder at depth h in the direction of tangent
// q = (a - x) / (z - h) from its ray; the half plane beyond hides the directions beyond. As in
// exact_truth_test.cpp, V may be off by what sampling misses, by edges that appear displaced by reach times
// the map texel's pitch (in metres, at any depth), and by epsilon and V's extremes within delta.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "support/baked_functions.h"
#include "support/exact_truth.h"
#include "support/sun_disk.h"
#include "support/truth_bounds.h"

namespace pdsm::test {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;
constexpr double kOccluder = 3, kFar = 8;

double tangent_of(double angle) {
  return std::tan(angle / 2 * kDegrees);
}

struct Setup {
  double angle;
  Method method;
};

class DistantLightTruth : public testing::TestWithParam<Setup> {
 protected:
  static constexpr std::uint32_t kSamples = 256;

  [[nodiscard]] static BakeOptions options(std::uint32_t width, std::uint32_t height,
                                           std::uint32_t map_scale) {
    return method_options(GetParam().method, width, height, kSamples, map_scale);
  }
  [[nodiscard]] static double angle() { return GetParam().angle; }
};

TEST(DiskBeyond, IsTheCircularSegmentForSmallAngles) {
  for (const double share : {-0.9, -0.3, 0.0, 0.5, 0.99}) {
    const double tangent = tangent_of(0.53);
    // Solid angle and tangents differ by tan^2 of the angle at the most.
    EXPECT_NEAR(disk_beyond(0.53, share * tangent), disk_half_plane(tangent, share * tangent), 3e-5) << share;
  }
}

/// The window is 6 penumbrae wide at the least, so that both its ends are seen.
TEST_P(DistantLightTruth, HalfPlane) {
  const double edge = 0.1, reach = 1.5 * tangent_of(angle()) * (kFar - kOccluder);
  Light light = distant_light(angle());
  light.window = {edge - reach, -0.5 * reach, edge + reach, 0.5 * reach};
  light.near_depth = 2;
  light.far_depth = kFar;
  Scene scene;
  add(scene, Plate{edge, -kWide, kWide, kWide, kOccluder});
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  const BakedFunctions baked(scene, light, options(33, 5, 4));
  // The quad's corners lie on a grid of floats at 1000, but the edge itself is a float at 0.1.
  const double displacement = texel_reach(GetParam().method.walk) * baked.map_pitch_x() + 0x1.0p-20;
  const double sampling = sampling_tolerance(2 * edge_strata(kSamples), kSamples),
               delta = baked.report().depth_tolerance, epsilon = baked.report().epsilon;
  int full = 0, part = 0, lit = 0;
  for (std::uint32_t i = 0; i < 33; ++i) {
    for (int n = 0; n <= 40; ++n) {
      const double z = 2 + (kFar - 2) * n / 40 * 0.999, value = baked.value(i, 2, z);
      const auto truth = [&](double depth, double shift) {
        return disk_beyond(angle(), (edge - shift - baked.slope_x(i)) / (depth - kOccluder));
      };
      if (z <= kOccluder) {
        ASSERT_EQ(value, 0) << z;
        continue;
      }
      // Right behind the occluder, within the bias, shadow begins.
      if (z <= kOccluder + baked.report().bias + 2 * delta) continue;
      const auto [low, high] = bound(truth, z, delta, displacement);
      ASSERT_GE(value, low - sampling - epsilon) << "texel " << i << ", z " << z;
      ASSERT_LE(value, high + sampling + epsilon) << "texel " << i << ", z " << z;
      full += low == 1;
      lit += high == 0;
      part += low > 0.2 && high < 0.8;
    }
  }
  EXPECT_GT(full, 100);
  EXPECT_GT(lit, 100);
  EXPECT_GT(part, 20);
}

/// On the axis behind a sphere: it hides the directions within asin(r / distance), all of the light up to the
/// end of the umbra's cone.
TEST_P(DistantLightTruth, SphereAgainstItsCone) {
  const double half = angle() / 2 * kDegrees, r = 2.5 * std::sin(half), h = kOccluder;
  const Mesh sphere = sphere_mesh({0, 0, h}, r, 5);
  const double cut_off = r - inscribed_radius(sphere, {0, 0, h});
  Scene scene;
  add(scene, sphere);
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  Light light = distant_light(angle());
  light.window = {-0.05 * r, -0.05 * r, 0.05 * r, 0.05 * r};
  light.near_depth = 2;
  light.far_depth = kFar;
  const BakedFunctions baked(scene, light, options(3, 3, 24));
  // Edges are displaced by a texel's diagonal; the slope bias allows for a PDSM texel, and delays the shadow
  // of a ring: where it exceeds the way to the point, so at normals more than alpha off the ray.
  const double moved = texel_reach(GetParam().method.walk) * baked.map_pitch_x() * std::sqrt(2.0);
  const double bias_reach = moved + (24 - 0.5) * baked.map_pitch_x() * std::sqrt(2.0);
  const double delta = baked.report().depth_tolerance, epsilon = baked.report().epsilon;
  const double sampling = sampling_tolerance(2 * outline_strata(kSamples), kSamples);
  const auto truth = [&](double radius, double z) {
    const double sine = std::clamp(radius / (z - h), 0.0, std::sin(half));
    return (1 - std::sqrt(1 - sine * sine)) / (1 - std::cos(half));
  };
  int umbra = 0, beyond = 0;
  for (double z = h + 1.2; z < kFar - 0.01; z += 0.2) {
    const double alpha = std::atan((z - delta - h - r - baked.report().bias) / bias_reach);
    const double ring = r * (1 - std::sin(alpha));
    const double low = truth(r - cut_off - moved - ring, z + delta), high = truth(r + moved, z - delta);
    const double value = baked.value(1, 1, z);
    EXPECT_GE(value, low - sampling - epsilon) << z;
    EXPECT_LE(value, high + sampling + epsilon) << z;
    umbra += low > 0.99;
    beyond += high < 0.6;
  }
  EXPECT_GT(umbra, 2);
  EXPECT_GT(beyond, 2);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, DistantLightTruth,
                         testing::Values(Setup{0.53, {Walk::exact, PointSet::lattice, 0.02}},
                                         Setup{0.53, {Walk::midpoint, PointSet::jittered, 0}},
                                         Setup{20, {Walk::exact, PointSet::jittered, 0}},
                                         Setup{20, {Walk::midpoint, PointSet::lattice, 0.02}},
                                         Setup{60, {Walk::exact, PointSet::lattice, 0}},
                                         Setup{60, {Walk::exact, PointSet::jittered, 0.01}}),
                         [](const auto& setup) { return "Case" + std::to_string(setup.index); });

/// A square plate, 2 x 2, three metres above a floor, both square to the sun; then moved.
struct Placement {
  const char* name;
  glm::dvec3 direction;
  glm::dvec3 offset;
};

class PlateShadow : public testing::TestWithParam<Placement> {};

/// The umbra is narrower, umbra and penumbra together wider than the plate by 2 * height * tan. Lossless, so
/// that both ends are those of the samples, which fill the light up to 1 / (2 N) of its area.
TEST_P(PlateShadow, UmbraAndPenumbraAreAsWideAsTheHeightSays) {
  constexpr double kHeight = 3, kAngle = 10;
  Light light = distant_light(kAngle);
  light.direction = GetParam().direction;
  light.up.reset();
  const RigidTransform to_world = inverse(light_frame(light));
  const auto& r = to_world.rotation;
  const glm::dmat4 placement =
      glm::translate(glm::dmat4(1), GetParam().offset) *
      glm::dmat4(r[0], r[3], r[6], 0, r[1], r[4], r[7], 0, r[2], r[5], r[8], 0, 0, 0, 0, 1);
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, 0}, Roles::caster);
  add(scene, Plate{-4, -4, 4, 4, kHeight}, Roles::receiver);
  for (Geometry& geometry : scene.geometry) geometry.local_to_world = placement;
  place_distant_light(scene, light);
  BakeOptions options = small_options(101, 101, 256);
  options.map_width = options.map_height = 404;
  options.epsilon = 0;
  const BakedFunctions baked(scene, light, options);

  const glm::dvec3 centre = apply(baked.view().world_to_view, glm::dvec3(placement[3]));
  const double z = centre.z + kHeight * (1 - 1e-6), spread = kHeight * tangent_of(kAngle);
  // A texel of a map either way; what moving by 1e6 costs in double is far below that.
  const double displaced = texel_reach(Walk::exact) * baked.map_pitch_x() + 1e-6;
  // Sunflower: the outermost of N points lie at sqrt(1 - 1 / (2 N)) of the radius; along an axis there is one
  // within half of the angle between neighbours of the outermost turn, which are at the golden angle: cos >=
  // 0.9.
  const double inner = 0.9 * spread;
  int umbra = 0, penumbra = 0, lit = 0;
  for (std::uint32_t i = 0; i < 101; ++i) {
    const double x = std::abs(baked.slope_x(i) - centre.x), value = baked.value(i, 50, z);
    if (x < 1 - spread - displaced) {
      EXPECT_EQ(value, 1) << x;
      ++umbra;
    } else if (x > 1 + spread + displaced) {
      EXPECT_EQ(value, 0) << x;
      ++lit;
    } else if (x > 1 - inner + displaced && x < 1 + inner - displaced) {
      EXPECT_GT(value, 0) << x;
      EXPECT_LT(value, 1) << x;
      ++penumbra;
    }
  }
  // The window is fitted to the shadow, 2 (1 + spread) wide: what lies outside is lit by definition.
  EXPECT_NEAR(baked.view().window[2] - baked.view().window[0], 2 * (1 + spread), 1e-4);
  EXPECT_GT(umbra, 50);
  EXPECT_GT(penumbra, 30);
  EXPECT_EQ(lit, 0);
}

INSTANTIATE_TEST_SUITE_P(
    EveryPlacement, PlateShadow,
    testing::Values(Placement{"AtTheOrigin", {0, 0, 1}, {0, 0, 0}},
                    Placement{"Slanted60", {std::sin(60 * kDegrees), -std::cos(60 * kDegrees), 0}, {1, 2, 3}},
                    Placement{"Horizontal", {1, 0, 0.3}, {0, 0, 0}},
                    Placement{"FromBelow", {0.2, 1, 0}, {5, 5, 5}},
                    Placement{"FarAway", {0.3, -1, 0.4}, {1e6, -2e6, 3e6}}),
    [](const auto& placement) { return placement.param.name; });

/// A plate beside the window, far in front: the sun's width carries its shadow in.
TEST(SunsDisk, CastersBesideTheWindowCount) {
  Light light = distant_light(40);
  light.window = {-1, -1, 1, 1};
  Scene scene;
  add(scene, Plate{1.5, -kWide, kWide, kWide, 2}, Roles::caster);
  add(scene, Plate{-9, -9, 9, 9, kFar}, Roles::receiver);
  const BakedFunctions baked(scene, light, small_options(32, 8, 256));
  EXPECT_NEAR(baked.view().near_depth, 2, 1e-4);
  EXPECT_FALSE(baked.baked().fitted.nothing_casts);
  const double sampling = sampling_tolerance(2 * edge_strata(256), 256);
  for (std::uint32_t i = 0; i < 32; ++i) {
    const double q = (1.5 - baked.slope_x(i)) / 5.9, moved = 0.5 * baked.map_pitch_x() / 5.9;
    EXPECT_GE(baked.value(i, 4, 7.9), disk_beyond(40, q + moved) - sampling - 0.02) << i;
    EXPECT_LE(baked.value(i, 4, 7.9), disk_beyond(40, q - moved) + sampling + 0.02) << i;
  }
  EXPECT_GT(baked.value(31, 4, 7.9), 0.2);
}

/// A wall along the light's axis stands before the part of the sun that is behind it, on either side.
TEST(SunsDisk, AWallAlongTheRaysHidesTheSunBehindIt) {
  Scene scene;
  add(scene, quad_mesh({0, -kWide, 2}, {0, kWide, 2}, {0, kWide, kFar}, {0, -kWide, kFar}), Roles::caster);
  add(scene, Plate{-9, -9, 9, 9, kFar}, Roles::receiver);
  Light light = distant_light(40);
  light.window = {-3, -3, 3, 3};
  const BakedFunctions baked(scene, light, small_options(192, 192, 256));
  const double sampling = sampling_tolerance(2 * edge_strata(256), 256), z = 7.9;
  for (std::uint32_t i = 0; i < 192; i += 5) {
    const double x = std::abs(baked.slope_x(i)), moved = 0.5 * baked.map_pitch_x();
    if (x < 2 * moved) continue;
    // The edge at depth 2; shadow of the wall's foot begins where the bias ends.
    EXPECT_GE(baked.value(i, 96, z), disk_beyond(40, (x + moved) / (z - 2)) - sampling - 0.02) << i;
    EXPECT_LE(baked.value(i, 96, z), disk_beyond(40, (x - moved) / (z - 2)) + sampling + 0.02) << i;
  }
}

}  // namespace
}  // namespace pdsm::test
