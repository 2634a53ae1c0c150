// SPDX-License-Identifier: Apache-2.0
// A plate over a floor, whose truth is known in closed form, so that each part of the budget can be held to
// what its cause alone may do.
#include "evaluate/error_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluate/point_parts.h"
#include "pdsm/format/error.h"
#include "plates.h"
#include "truth/random.h"

namespace pdsm {
namespace {

constexpr double kPlate = 0.5, kPlateDepth = 4, kFloorDepth = 8;
/// A value's rounding to float, as look-ups round, once in each of two values that are compared.
constexpr double kFloatRounding = 0x1p-24;

/// A light of 1 x 1 m over a plate and a floor, seen through a window that holds the whole shadow.
Scene plate_over_floor() {
  Scene scene;
  scene.lights = {light_at_origin(RectLight{1, 1})};
  scene.lights[0].window = {-0.3, -0.3, 0.3, 0.3};
  scene.lights[0].near_depth = 2;
  scene.geometry = {plate(-kPlate, -kPlate, kPlate, kPlate, kPlateDepth),
                    plate(-40, -40, 40, 40, kFloorDepth)};
  return scene;
}

PenumbraMap bake_map(const Scene& scene, const BakeOptions& options) {
  return decode_blocks(bake(scene, scene.lights[0], options));
}

/// Share of the light's width that the plate hides from x at depth z.
double hidden_width(double x, double z) {
  // The line from the light's s through the plate's edge at x: s = (edge z - x h) / (z - h).
  const auto on_light = [&](double edge) {
    return std::clamp((edge * z - x * kPlateDepth) / (z - kPlateDepth), -0.5, 0.5);
  };
  return on_light(kPlate) - on_light(-kPlate);
}

double true_attenuation(const glm::dvec3& p) {
  return p.z <= kPlateDepth ? 0 : hidden_width(p.x, p.z) * hidden_width(p.y, p.z);
}

/// Points under the plate, up to the floor but not on it, with the truth in closed form.
ProbedTruth known_truth(std::uint32_t count) {
  ProbedTruth truth;
  for (std::uint32_t n = 0; n < count; ++n) {
    const double z = 4.5 + 3.4 * hash_unit(7, n);
    const std::array<double, 2> unit = hash_unit_pair(8, n);
    truth.points.emplace_back((0.5 * unit[0] - 0.25) * z, (0.5 * unit[1] - 0.25) * z, z);
    truth.a.push_back(grey(true_attenuation(truth.points.back())));
  }
  truth.b = truth.a;
  return truth;
}

/// Share of a bake's samples that the plate hides, by its own arithmetic.
double hidden_samples(const PenumbraMap& map, const glm::dvec3& p) {
  int hidden = 0;
  for (const LightSample& s : map.samples) {
    const double t = kPlateDepth / p.z;
    const double x = s.position[0] + t * (p.x - s.position[0]), y = s.position[1] + t * (p.y - s.position[1]);
    hidden += std::abs(x) <= kPlate && std::abs(y) <= kPlate ? 1 : 0;
  }
  return static_cast<double>(hidden) / static_cast<double>(map.samples.size());
}

double largest(const std::vector<double>& changes) {
  double most = 0;
  for (const double change : changes) most = std::max(most, std::abs(change));
  return most;
}

PointParts parts_of(const Scene& scene, const BakeOptions& options, const ProbedTruth& truth) {
  return measure_point_parts(bake_map(scene, options), scene, scene.lights[0], options, truth);
}

ErrorBudget budget_of(const Scene& scene, const BakeOptions& options, const ProbedTruth& truth) {
  return measure_error_budget(bake_map(scene, options), scene, scene.lights[0], options, truth);
}

/// Options that go different ways through the bake.
std::vector<BakeOptions> various_options() {
  std::vector<BakeOptions> all(6, small_options());
  all[1].epsilon = 0;
  all[2].receivers = Receivers::surfaces;
  all[3].walk = Walk::midpoint;
  all[3].points = PointSet::jittered;
  all[3].map_width = 96;
  all[4].mip_levels = 3;
  all[4].receivers = Receivers::all;
  all[5].epsilon = 0.001;
  all[5].light_samples = make_light_samples(plate_over_floor().lights[0], 37, PointSet::jittered, 3);
  return all;
}

TEST(ErrorBudget, PartsAddUpToTheError) {
  const Scene scene = plate_over_floor();
  VerifyOptions few;
  few.points = 300;
  few.samples = 64;
  // Five differences and five sums, each of numbers up to 2 in magnitude.
  constexpr double kRounding = 10 * 2 * 0x1p-53;
  for (const BakeOptions& options : various_options()) {
    few.free_space = options.receivers != Receivers::surfaces;
    const PenumbraMap map = bake_map(scene, options);
    const ProbedTruth truth = probe_truth(map, scene, scene.lights[0], few);
    const PointParts parts = measure_point_parts(map, scene, scene.lights[0], options, truth);
    for (std::size_t n = 0; n < truth.points.size(); ++n)
      ASSERT_NEAR(parts.sum(n), parts.total[n], kRounding);
    const ErrorBudget budget = measure_error_budget(map, scene, scene.lights[0], options, truth);
    const VerifyResult result = verify(map, truth);
    EXPECT_LE(budget.telescoping_fault, kRounding);
    EXPECT_DOUBLE_EQ(budget.total.rms, result.rms_error);
    EXPECT_DOUBLE_EQ(budget.total.mean_abs, result.mean_abs_error);
    EXPECT_DOUBLE_EQ(budget.total.bias, result.bias);
    // An end of a piece is at most a code off: half by rounding, and constants are kept within the tube.
    EXPECT_LE(largest(parts.quantisation), 1.0 / map.coding.value_max + kFloatRounding);
  }
}

TEST(ErrorBudget, NoSamplingErrorAgainstItsOwnSamples) {
  const Scene scene = plate_over_floor();
  const PenumbraMap map = bake_map(scene, small_options());
  ProbedTruth truth = known_truth(500);
  for (std::size_t n = 0; n < truth.points.size(); ++n)
    truth.a[n] = truth.b[n] = grey(hidden_samples(map, truth.points[n]));
  const PointParts parts = measure_point_parts(map, scene, scene.lights[0], small_options(), truth);
  EXPECT_EQ(largest(parts.sampling), 0);
  EXPECT_GT(largest(parts.filter), 0);
  EXPECT_GT(largest(parts.map), 0);
}

TEST(ErrorBudget, SamplingIsWithinItsBound) {
  // n x n jittered samples, a closed convex outline: 4n - 4 strata hold an edge (Hoeffding, ln(2e6)).
  const Scene scene = plate_over_floor();
  const ProbedTruth truth = known_truth(400);
  double before = 1;
  for (const std::uint32_t side : {8U, 32U}) {
    BakeOptions options = small_options();
    options.points = PointSet::jittered;
    options.samples = side * side;
    const PointParts parts = parts_of(scene, options, truth);
    const double bound = std::sqrt((4 * side - 4) * 14.509 / 2) / options.samples;
    EXPECT_LE(largest(parts.sampling), bound) << side;
    EXPECT_GT(largest(parts.sampling), 0) << side;
    // K / N^2 has a sixteenth of its root's expectation a quarter as far on: an eighth in all.
    EXPECT_LT(largest(parts.sampling), before / 3) << side;
    before = largest(parts.sampling);
  }
}

TEST(ErrorBudget, LosslessMapsHaveNoFitAndNoQuantisation) {
  BakeOptions options = small_options();
  options.epsilon = 0;
  options.depth_tolerance = 0;
  const PointParts parts = parts_of(plate_over_floor(), options, known_truth(400));
  EXPECT_LE(largest(parts.fit), kFloatRounding);
  EXPECT_EQ(largest(parts.quantisation), 0);
  EXPECT_GT(largest(parts.map), 0);
}

TEST(ErrorBudget, FitIsWithinEpsilon) {
  for (const double epsilon : {0.08, 0.005}) {
    BakeOptions options = small_options();
    options.epsilon = epsilon;
    options.samples = 512;        // steps of less than 2 epsilon, that a piece can run through
    options.depth_tolerance = 0;  // else an event may move, and a look-up at it jumps
    const PointParts parts = parts_of(plate_over_floor(), options, known_truth(400));
    EXPECT_LE(largest(parts.fit), epsilon + kFloatRounding);
    EXPECT_GT(largest(parts.fit), epsilon / 2);
    // epsilon = 0.005 takes values of 16 bits.
    const double code = epsilon > 0.05 ? 1.0 / 255 : 1.0 / 65535;
    EXPECT_LE(largest(parts.quantisation), code + kFloatRounding);
    EXPECT_GT(largest(parts.quantisation), 0);
  }
}

TEST(ErrorBudget, WhatIsStoredIsNoMatterOfTheMap) {
  // Epsilon, delta and where functions are exact decide what is kept of a bake, not what it saw.
  const Scene scene = plate_over_floor();
  const ProbedTruth truth = known_truth(200);
  const PointParts exact = parts_of(scene, small_options(), truth);
  std::vector<BakeOptions> all(3, small_options());
  all[0].epsilon = 0.2;
  all[1].depth_tolerance = 0.5;
  all[2].receivers = Receivers::surfaces;  // and these points are in free space
  for (const BakeOptions& options : all) {
    const PointParts parts = parts_of(scene, options, truth);
    EXPECT_EQ(parts.sampling, exact.sampling);
    EXPECT_EQ(parts.filter, exact.filter);
    EXPECT_EQ(parts.map, exact.map);
    EXPECT_NE(parts.fit, exact.fit);
  }
}

TEST(ErrorBudget, ResolutionBuysMapAndFilterAlone) {
  // Both are displacements by a share of a texel: four times the texels along each axis, a quarter of it, or
  // less where V is smooth. Sampling knows no texels.
  const Scene scene = plate_over_floor();
  const ProbedTruth truth = known_truth(1000);
  BakeOptions coarse = small_options(), fine = small_options();
  fine.width *= 4;
  fine.height *= 4;
  const ErrorBudget before = budget_of(scene, coarse, truth), after = budget_of(scene, fine, truth);
  EXPECT_LT(after.map.rms, before.map.rms / 2);
  EXPECT_LT(after.filter.rms, before.filter.rms / 2);
  EXPECT_EQ(after.sampling.rms, before.sampling.rms);
  EXPECT_GT(after.map.rms, 0);
  EXPECT_GT(after.filter.rms, 0);
}

/// A floor that rises by `slope` along x, seen alone or under the same window over another floor.
Scene slanted(double slope, bool over_floor) {
  Scene scene = plate_over_floor();
  const auto corner = [slope](double x, double y) { return glm::vec3(x, y, 6 + slope * x); };
  const double wide = 3;
  scene.geometry = {quad(corner(-wide, -wide), corner(wide, -wide), corner(wide, wide), corner(-wide, wide))};
  if (over_floor) scene.geometry.push_back(plate(-40, -40, 40, 40, 18));
  return scene;
}

/// Lit points on it, away from its border.
ProbedTruth lit_points(double slope) {
  ProbedTruth truth;
  for (std::uint32_t n = 0; n < 300; ++n) {
    const std::array<double, 2> unit = hash_unit_pair(9, n);
    const double x = unit[0] - 0.5, y = unit[1] - 0.5;
    truth.points.emplace_back(x, y, 6 + slope * x);
  }
  truth.surface_points = truth.points.size();
  truth.a = truth.b = std::vector(truth.points.size(), grey(0));
  return truth;
}

TEST(ErrorBudget, RaysBehindALitFloorAreNoError) {
  // Neighbouring rays are behind the floor at the point's depth, but their domain ends at the floor.
  // Without a bias, that alone keeps them lit.
  const double slope = 1.5;
  BakeOptions options = small_options();
  options.bias = 0;
  const PointParts parts = parts_of(slanted(slope, false), options, lit_points(slope));
  for (const auto* part : {&parts.sampling, &parts.filter, &parts.map, &parts.fit, &parts.quantisation})
    EXPECT_EQ(largest(*part), 0);
}

TEST(ErrorBudget, WhatTheBiasTakesOutIsNoError) {
  // Over another floor, the domain reaches behind the slanted one: only the bias tells its own shadow apart.
  // A texel is 0.6 / 40 of slope, so the surface rises by 1.5 * 0.015 * 7 m = 0.16 m in one at the most.
  const double slope = 1.5;
  const Scene scene = slanted(slope, true);
  BakeOptions options = small_options();
  options.bias = 0.2;
  const PointParts parts = parts_of(scene, options, lit_points(slope));
  for (const auto* part : {&parts.sampling, &parts.filter, &parts.map, &parts.fit, &parts.quantisation})
    EXPECT_EQ(largest(*part), 0);
  // Without it, a whole texel is left of it for slopes, as far as look-ups ask to the side.
  options.bias = 0;
  const PointParts reached = parts_of(scene, options, lit_points(slope));
  EXPECT_EQ(largest(reached.filter), 0);
  // The maps' own texels take half of it, which leaves too little for some look-ups.
  EXPECT_GT(largest(reached.map), 0);
  // Where they are half as large, look-ups get as much more.
  options.map_width = options.map_height = 2 * options.width;
  EXPECT_EQ(largest(parts_of(scene, options, lit_points(slope)).filter), 0);
}

TEST(ErrorBudget, TheBiasReachesByTheSlope) {
  // The slanted floor gets deeper along x. Points 0.2 texels beside a ray: on that ray, the floor is 0.2
  // texels' slope before their depth, on the next one it is behind it. A whole texel is allowed for, of
  // which shadow maps take 1/2.
  const double slope = 1.5, pitch = 0.6 / small_options().width;
  ProbedTruth truth;
  for (int i = -8; i < 8; ++i) {
    // On the ray u, x = u z and z = 6 + slope x.
    const double u = (i + 0.5 + 0.2) * pitch, z = 6 / (1 - slope * u);
    truth.points.emplace_back(u * z, 0.5 * pitch * z, z);
  }
  truth.a = truth.b = std::vector(truth.points.size(), grey(0));
  BakeOptions options = small_options();
  options.bias = 0;
  const PointParts parts = parts_of(slanted(slope, true), options, truth);
  EXPECT_EQ(largest(parts.filter), 0);
  EXPECT_EQ(largest(parts.map), 0);
}

TEST(ErrorBudget, LeaksOfTheBiasAreTold) {
  // Points 0.1 m under a plate whose shadow begins 0.3 m behind it: in full shadow, lit in the map.
  const Scene scene = plate_over_floor();
  ProbedTruth truth;
  for (const double x : {-0.2, -0.1, 0.0, 0.1, 0.2}) truth.points.emplace_back(x, 0.05, kPlateDepth + 0.1);
  truth.a = truth.b = std::vector(truth.points.size(), grey(1));
  BakeOptions options = small_options();
  options.bias = 0.3;
  const PointParts parts = parts_of(scene, options, truth);
  for (std::size_t n = 0; n < truth.points.size(); ++n) {
    EXPECT_EQ(parts.depth_bias[n], -1);
    EXPECT_EQ(parts.filter[n], -1);
    EXPECT_EQ(parts.map[n], 0);
    EXPECT_EQ(parts.sampling[n], 0);
    EXPECT_EQ(parts.total[n], -1);
  }
}

TEST(ErrorBudget, AnotherSceneOrOptionsAreRefused) {
  const Scene scene = plate_over_floor();
  const BakeOptions options = small_options();
  const PenumbraMap map = bake_map(scene, options);
  const ProbedTruth truth = known_truth(10);
  const auto fault = [&](const Scene& other, const BakeOptions& with) -> std::string {
    try {
      (void)measure_error_budget(map, other, other.lights[0], with, truth);
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      return error.what();
    }
    return "none";
  };
  Scene other = scene;
  other.lights[0].window = {-0.2, -0.3, 0.3, 0.3};
  EXPECT_EQ(fault(other, options).find("error budget: the map's view"), 0U);
  BakeOptions larger = options;
  larger.width = 64;
  EXPECT_EQ(fault(scene, larger).find("error budget: the map's view"), 0U);
  BakeOptions jittered = options;
  jittered.points = PointSet::jittered;
  EXPECT_EQ(fault(scene, jittered).find("error budget: the map's light samples"), 0U);
  EXPECT_EQ(fault(scene, options), "none");
}

}  // namespace
}  // namespace pdsm
