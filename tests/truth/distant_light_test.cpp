// SPDX-License-Identifier: Apache-2.0
// The truth under a distant light, in closed form: what shadow rays and verify's parts make of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "evaluate/point_parts.h"
#include "evaluate/verify.h"
#include "plates.h"
#include "support/sun_disk.h"
#include "truth/light_points.h"
#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

constexpr double kPi = std::numbers::pi, kDegrees = kPi / 180;
constexpr std::uint32_t kSide = 32, kSamples = kSide * kSide;
/// log(2 / 1e-6): of a comparison's probability to fail.
constexpr double kLogFailure = 14.508657738524219;

/// What n x n jittered samples may miss of a shape with a convex outline (Hoeffding), and rounding.
double tolerance() {
  return std::sqrt((4 * kSide - 4) * kLogFailure / 2) / kSamples + 1e-6;
}

Scene scene_of(std::vector<Geometry> geometry, const Light& light) {
  Scene scene;
  scene.geometry = std::move(geometry);
  scene.lights = {light};
  return scene;
}

TEST(DistantLightPoint, KeepsSolidAngles) {
  // A grid of equal cells, as for the disk: the share within angle t of the centre is that of the caps'
  // heights.
  constexpr std::uint32_t kCells = 256;
  for (const double angle : {0.53, 40.0, 90.0}) {
    const Light light = light_at_origin(DistantLight{angle});
    for (const double share : {0.25, 0.5, 0.9}) {
      const double t = share * angle / 2 * kDegrees;
      std::uint32_t inside = 0;
      for (std::uint32_t i = 0; i < kCells * kCells; ++i) {
        const glm::dvec3 d = light_point(
            light, {(i % kCells + 0.5) / kCells, (static_cast<double>(i / kCells) + 0.5) / kCells});
        ASSERT_EQ(d.z, 1);
        ASSERT_LE(std::hypot(d.x, d.y), std::tan(angle / 2 * kDegrees) * (1 + 1e-12));
        inside += std::hypot(d.x, d.y) <= std::tan(t) ? 1 : 0;
      }
      const double expected = (1 - std::cos(t)) / (1 - std::cos(angle / 2 * kDegrees));
      EXPECT_NEAR(inside, expected * kCells * kCells, 4 * kCells) << angle << ", " << share;
    }
    EXPECT_EQ(light_point(light, {0.5, 0.5}), glm::dvec3(0, 0, 1));
  }
  EXPECT_EQ(light_point(light_at_origin(DistantLight{0}), {0.9, 0.1}), glm::dvec3(0, 0, 1));
}

TEST(DistantShadowRays, HalfPlaneIsExact) {
  const double h = 3, z = 7;
  for (const double angle : {0.53, 30.0, 80.0}) {
    const double most = std::tan(angle / 2 * kDegrees);
    for (int step = 0; step < 8; ++step) {
      const double normal = 0.05 + step * kPi / 4;
      for (const double q : {-1.1, -0.6, 0.0, 0.2, 0.9, 1.1}) {
        const Light light = light_at_origin(DistantLight{angle});
        const double at = 0.7, edge = at + q * most * (z - h);
        const ShadowRays rays(scene_of({half_plane(normal, edge, h)}, light), light, 1);
        const glm::dvec3 p(at * std::cos(normal), at * std::sin(normal), z);
        // Floats of the quad's corners, at 200, move its edge by up to 2^-17; in light, by half of the
        // greatest density of a line in the disk, 1.3 / (2 most) for a metre at 4 m.
        const double rounding = 0x1.0p-16 / (z - h) / most;
        EXPECT_NEAR(rays.attenuation(p, kSamples, 1), test::disk_beyond(angle, q * most),
                    tolerance() + rounding)
            << angle << ", " << step << ", " << q;
      }
    }
  }
}

TEST(DistantShadowRays, SphereAgainstItsCone) {
  const double radius = 0.4, h = 4, angle = 10;
  constexpr std::uint32_t kRings = 200;
  const Light light = light_at_origin(DistantLight{angle});
  const ShadowRays rays(scene_of({sphere({0, 0, h}, radius, kRings)}, light), light, 1);
  const double flattened = std::pow(std::cos(kPi / kRings), 2), half = angle / 2 * kDegrees;
  const auto hidden = [&](double r, double z) {
    const double sine = std::min(r / (z - h), std::sin(half));
    return (1 - std::sqrt(1 - sine * sine)) / (1 - std::cos(half));
  };
  // The umbra ends 0.4 / sin 5 degrees = 4.59 m behind the centre.
  for (const double z : {5.0, 7.0, 8.4, 9.5, 12.0, 20.0}) {
    const double value = rays.attenuation({0, 0, z}, kSamples, 2);
    EXPECT_LE(value, hidden(radius, z) + tolerance()) << z;
    EXPECT_GE(value, hidden(radius * flattened, z) - tolerance()) << z;
    if (z < 8.5) {
      EXPECT_EQ(value, 1) << z;
    }
  }
}

TEST(DistantShadowRays, FarFromTheOriginAndSlantedNothingIsLost) {
  const double angle = 5;
  const Light here = light_at_origin(DistantLight{angle});
  const ShadowRays rays(scene_of({plate(-0.3, -0.2, 0.5, 0.4, 4)}, here), here, 1);
  const glm::dvec3 offset(3e6, -2e6, 1e6);
  const glm::dmat4 placement = glm::rotate(glm::translate(glm::dmat4(1), offset), 1.1, glm::dvec3(0, 1, 0));
  Light there = here;
  there.direction = glm::dvec3(placement[2]);
  there.up = glm::dvec3(placement[1]);
  Geometry moved = plate(-0.3, -0.2, 0.5, 0.4, 4);
  moved.local_to_world = placement;
  const Scene scene = scene_of({moved}, there);
  place_distant_light(scene, there);
  const ShadowRays far_rays(scene, there, 1);
  for (std::uint32_t n = 0; n < 50; ++n) {
    const glm::dvec3 p(1.4 * hash_unit(3, n) - 0.6, hash_unit(4, n) - 0.4, 5 + 3 * hash_unit(5, n));
    const double value = far_rays.attenuation(glm::dvec3(placement * glm::dvec4(p, 1)), kSamples, 6);
    // The same points of the light: only rays that pass an edge within rounding may differ, 2 of 1024.
    EXPECT_NEAR(value, rays.attenuation(p, kSamples, 6), 2.0 / kSamples) << n;
  }
}

TEST(DistantShadowRays, EverythingInFrontBlocksWhateverNearIs) {
  const Light light = light_at_origin(DistantLight{1});
  const ShadowRays rays(scene_of({plate(-9, -9, 9, 9, 1e-5)}, light), light, 5);
  EXPECT_EQ(rays.attenuation({0, 0, 6}, 64, 0), 1);
  EXPECT_EQ(rays.attenuation({0, 0, -1}, 64, 0), 0) << "nothing casts before light space begins";
}

TEST(DistantShadowRays, GivenDirectionsHaveABias) {
  // A caster of slope 1 half a metre before p: with a reach of 0.2 m its shadow begins 0.2 m behind it,
  // with one of 0.6 m behind p. Parallel rays: no matter how deep it lies.
  const Light light = light_at_origin(DistantLight{1});
  for (const double depth : {2.0, 200.0}) {
    const ShadowRays rays(
        scene_of({quad({-1, -1, depth - 1}, {1, -1, depth + 1}, {1, 1, depth + 1}, {-1, 1, depth - 1})},
                 light),
        light, 1);
    CasterBias bias{0, 1e9};
    bias.parallel = true;
    const glm::dvec3 p(0, 0, depth + 0.5);
    const std::vector<LightPoint> points{{{0, 0, 1}, {0.2, 0}}, {{0, 0, 1}, {0.6, 0}}, {{0, 0, 1}, {0.2, 9}}};
    EXPECT_DOUBLE_EQ(rays.attenuation(p, points), 1);
    EXPECT_DOUBLE_EQ(rays.attenuation(p, points, &bias), 2 / 3.0) << depth;
    // A constant counts in metres of depth.
    for (const double constant : {0.4, 0.6}) {
      bias.constant = constant;
      const std::vector<LightPoint> centre{{{0, 0, 1}, {0, 0}}};
      EXPECT_EQ(rays.attenuation(p, centre, &bias), constant < 0.5 ? 1 : 0) << depth;
    }
  }
}

/// A plate over a floor, under a sun of 20 degrees.
constexpr double kPlate = 0.5, kPlateDepth = 4, kFloorDepth = 8;

Scene plate_over_floor() {
  Scene scene;
  scene.lights = {light_at_origin(DistantLight{20})};
  scene.lights[0].window = {-1.5, -1.5, 1.5, 1.5};
  scene.geometry = {plate(-kPlate, -kPlate, kPlate, kPlate, kPlateDepth),
                    plate(-40, -40, 40, 40, kFloorDepth)};
  return scene;
}

double hidden_samples(const PenumbraMap& map, const glm::dvec3& p) {
  double hidden = 0;
  for (const LightSample& s : map.samples) {
    const double x = p.x - s.position[0] * (p.z - kPlateDepth), y = p.y - s.position[1] * (p.z - kPlateDepth);
    hidden += std::abs(x) < kPlate && std::abs(y) < kPlate ? 1 : 0;
  }
  return hidden / static_cast<double>(map.samples.size());
}

TEST(DistantErrorBudget, PartsAddUpAndSamplingIsThatOfItsOwnSamples) {
  const Scene scene = plate_over_floor();
  const BakeOptions options = small_options();
  const PenumbraMap map = decode_blocks(bake(scene, scene.lights[0], options));
  ProbedTruth truth;
  for (std::uint32_t n = 0; n < 300; ++n) {
    const std::array<double, 2> unit = hash_unit_pair(8, n);
    truth.points.emplace_back(2.8 * unit[0] - 1.4, 2.8 * unit[1] - 1.4, 4.5 + 3.4 * hash_unit(7, n));
    truth.a.push_back(grey(hidden_samples(map, truth.points.back())));
  }
  truth.b = truth.a;
  const PointParts parts = measure_point_parts(map, scene, scene.lights[0], options, truth);
  double filter = 0;
  for (std::size_t n = 0; n < truth.points.size(); ++n) {
    // A sample may pass the plate's edge within the rounding of rays.
    EXPECT_NEAR(parts.sampling[n], 0, 1.0 / 64 + 1e-12) << n;
    EXPECT_NEAR(parts.sum(n), parts.total[n], 1e-12) << n;
    EXPECT_LE(std::abs(parts.fit[n]), 2 * options.epsilon + 0x1p-20) << n;
    filter += std::abs(parts.filter[n]);
  }
  EXPECT_GT(filter, 0);
}

/// A caster of slope 1 has a bias of a texel and a quarter, 0.0375 m, wherever light space begins: 0.2 m
/// behind it the shadow is whole.
TEST(DistantErrorBudget, TheBiasReachesByThePitchAlone) {
  Scene scene;
  scene.lights = {light_at_origin(DistantLight{0})};
  scene.lights[0].window = {-0.3, -0.3, 0.3, 0.3};
  scene.geometry = {quad({-0.4, -0.4, 0.6}, {0.4, -0.4, 1.4}, {0.4, 0.4, 1.4}, {-0.4, 0.4, 0.6}),
                    plate(-9, -9, 9, 9, 1.5)};
  scene.geometry[0].receives = false;
  BakeOptions options = small_options();
  options.width = options.height = 20;
  const PenumbraMap map = decode_blocks(bake(scene, scene.lights[0], options));
  ProbedTruth truth;
  for (const double x : {-0.2, -0.1, 0.0, 0.05}) truth.points.emplace_back(x, 0.1, 1.2 + x);
  truth.a = truth.b = std::vector(4, grey(1));
  const PointParts parts = measure_point_parts(map, scene, scene.lights[0], options, truth);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(parts.depth_bias[n], 0) << n;
    EXPECT_EQ(parts.filter[n], 0) << n;
  }
}

TEST(DistantErrorBudget, ALitSlopeHasNoError) {
  Scene scene;
  scene.lights = {light_at_origin(DistantLight{20})};
  scene.lights[0].window = {-1, -1, 1, 1};
  scene.geometry = {quad({-9, -9, 12 - 9}, {9, -9, 12 + 9}, {9, 9, 12 + 9}, {-9, 9, 12 - 9})};
  VerifyOptions options;
  options.points = 300;
  options.free_space =
      false;  // behind the slope, within a texel, there is shadow that no function has to hold
  options.samples = 64;
  const PenumbraMap map = decode_blocks(bake(scene, scene.lights[0], small_options()));
  const VerifyResult result = verify(map, scene, scene.lights[0], options);
  EXPECT_GT(result.surface_points, 100U);
  EXPECT_EQ(result.max_error, 0);
}

TEST(DistantVerify, FindsTheErrorThatTheTruthHas) {
  // Against the whole light: what 256 samples miss, the plate's edges off by a texel's reach, and epsilon.
  const Scene scene = plate_over_floor();
  BakeOptions options = small_options();
  options.samples = 256;
  options.width = options.height = 96;
  const PenumbraMap map = decode_blocks(bake(scene, scene.lights[0], options));
  VerifyOptions points;
  points.points = 600;
  points.samples = 1024;
  const VerifyResult result = verify(map, scene, scene.lights[0], points);
  EXPECT_EQ(result.surface_points, 300U);
  EXPECT_GT(result.shadowed_points, 60U);
  EXPECT_GT(result.mean_abs_error, 0);
  EXPECT_LT(result.mean_abs_error, 0.05);
}

}  // namespace
}  // namespace pdsm
