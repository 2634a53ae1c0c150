// SPDX-License-Identifier: Apache-2.0
// Casters that are curves: hair, grass, wires.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pdsm/bake/map_key.h"
#include "pdsm/format/error.h"
#include "scene/caster_hull.h"
#include "support/baked_functions.h"
#include "support/checkpoint_case.h"
#include "support/compare.h"
#include "support/exact_truth.h"
#include "support/fur.h"
#include "support/job_blocks.h"
#include "support/merged_shards.h"
#include "support/translucent.h"

namespace pdsm::test {
namespace {

constexpr double kDepth = 4, kFar = 8;

Curves bar_along_y(float radius, CurveShape shape) {
  return one_strand({{0.1F, -40, kDepth, radius}, {0.1F, 40, kDepth, radius}}, shape);
}

/// Share of a light 1 m wide that a bar along y through (0.1, kDepth) hides from (x, z): tube or ribbon, what
/// passes its axis within the radius.
double hidden_by_bar(double radius, double x, double z) {
  if (radius <= 0) return 0;
  const double across = 0.1 - x, along = z - kDepth;
  const double half = std::asin(radius / std::hypot(across, along));
  const auto on_light = [&](double angle) {
    return std::clamp(x + z * std::tan(std::atan2(across, along) + angle), -0.5, 0.5);
  };
  return on_light(half) - on_light(-half);
}

TEST(Curves, ABarHidesWhatIsBehindIt) {
  constexpr std::uint32_t kSamples = 256;
  constexpr float kRadius = 0.15F;
  for (const CurveShape shape : {CurveShape::round, CurveShape::flat}) {
    Scene scene;
    scene.curves = {bar_along_y(kRadius, shape)};
    add(scene, everywhere(kFar));
    const BakedFunctions baked(scene, square_light(), small_options(160, 8, kSamples));
    const double moved = texel_reach(Walk::exact) * baked.map_pitch_x() * kDepth;
    const double delta = baked.report().depth_tolerance + baked.report().bias;
    const double slack = sampling_tolerance(2 * edge_strata(kSamples), kSamples) + baked.report().epsilon;
    for (std::uint32_t i = 0; i < 160; i += 3) {
      for (const double z : {4.6, 5.5, 7.0, 7.9}) {
        double low = 1, high = 0;
        for (const double depth : {z - delta, z, z + delta}) {
          const double x = baked.slope_x(i) * depth, radius = static_cast<double>(kRadius);
          low = std::min(low, hidden_by_bar(radius - moved, x, depth));
          high = std::max(high, hidden_by_bar(radius + moved, x, depth));
        }
        EXPECT_GE(baked.value(i, 4, z), low - slack) << i << " " << z;
        EXPECT_LE(baked.value(i, 4, z), high + slack) << i << " " << z;
      }
    }
  }
}

/// Hairs of a tenth of a map texel, aslant so that no two rows of rays see them alike.
TEST(Curves, ThinHairsKeepTheirMeanCoverage) {
  constexpr std::uint32_t kEdge = 96, kSamples = 64;
  const double texel = kDepth / kEdge, radius = 0.05 * texel, spacing = 0.37 * texel;
  const glm::dvec3 along(std::sin(0.3), std::cos(0.3), 0), across(along.y, -along.x, 0);
  auto strands = std::make_shared<Strands>();
  for (int n = -200; n <= 200; ++n) {
    const glm::dvec3 middle = n * spacing * across + glm::dvec3(0, 0, kDepth);
    strands->segments.push_back(static_cast<std::uint32_t>(strands->points.size()));
    for (const double end : {-8.0, 8.0})
      strands->points.emplace_back(glm::vec3(middle + end * along), static_cast<float>(radius));
  }
  Curves comb;
  comb.name = "comb";
  comb.strands = strands;
  Scene scene;
  scene.curves = {comb};
  add(scene, everywhere(kFar));
  Light point = rect_light(0, 0);
  set_view(point, 0.5, 0.5, 2, kFar);
  BakeOptions options = small_options(kEdge, kEdge, kSamples);
  options.epsilon = 0;
  const BakedFunctions baked(scene, point, options);
  double sum = 0;
  for (std::uint32_t j = 0; j < kEdge; ++j)
    for (std::uint32_t i = 0; i < kEdge; ++i) sum += baked.value(i, j, 7);
  const double coverage = 2 * radius / spacing;
  // Five standard deviations of as many independent rays as columns and samples: those of a column may see
  // the same.
  const double tolerance = 5 * std::sqrt(coverage * (1 - coverage) / (kEdge * kSamples));
  EXPECT_NEAR(sum / (kEdge * kEdge), coverage, tolerance);
}

TEST(Curves, CastUnderTheSunAndToAllSides) {
  Scene scene;
  scene.curves = {bar_along_y(0.3F, CurveShape::round)};
  add(scene, everywhere(kFar), Roles::receiver);
  Light sun = distant_light(0.5);
  set_view(sun, 1, 1, 2, kFar);
  const BakedFunctions parallel(scene, sun, small_options(32, 32, 16));
  EXPECT_EQ(parallel.value(17, 16, 7), 1);
  EXPECT_EQ(parallel.value(2, 16, 7), 0);
  Light bulb = rect_light(1, 1);
  bulb.shape = SphereLight{0.05};
  const BakedMap around = bake(scene, bulb, small_options(64, 64, 16));
  EXPECT_GT(around.report.events, 100U);
}

Scene fur_scene() {
  Scene scene;
  scene.curves = {random_fur({0, 0, 4}, 0.6, 400, 1)};
  scene.curves.push_back(random_fur({0.3, 0.2, 5}, 0.3, 100, 2));
  scene.curves.back().shape = CurveShape::flat;
  add(scene, Plate{-0.5, -0.5, 0, 0.5, 5.5});
  add(scene, everywhere(kFar));
  return scene;
}

TEST(Curves, ThreadsTilesAndShardsGiveTheSameBytes) {
  BakeOptions options = small_options(150, 150, 16);
  options.mip_levels = 1;
  const BakedMap whole = bake(fur_scene(), square_light(), options);
  EXPECT_GT(whole.report.events, 10000U);
  options.tile = 64;
  options.threads = 3;
  expect_same_bake(bake(fur_scene(), square_light(), options), whole);
  expect_same_bake(bake_in_shards(fur_scene(), square_light(), options, 2), whole);
}

TEST(Curves, RaysThatAreLeftOutHaveNoEvents) {
  Light bulb = rect_light(1, 1);
  bulb.shape = SphereLight{0.2};
  Scene fur = fur_scene();
  fur.geometry.clear();
  add(fur, everywhere(kFar), Roles::receiver);
  for (std::uint32_t view = 0; view < 6; ++view) {
    const BakeJob job(fur, bulb, small_options(96, 96, 9), {}, {view, 0});
    ASSERT_FALSE(job.shift_law());
    EXPECT_EQ(job_blocks(job, true), job_blocks(job, false)) << view;
  }
}

TEST(Curves, KeysTellThemApart) {
  const BakeOptions options = small_options(64, 64, 9);
  const auto key_of = [&](const Scene& scene) { return map_key(scene, square_light(), options).key; };
  const std::string key = key_of(fur_scene());
  EXPECT_EQ(key, bake(fur_scene(), square_light(), options).report.key);
  Scene other = fur_scene();
  other.curves[0].shape = CurveShape::flat;
  EXPECT_NE(key, key_of(other));
  other = fur_scene();
  other.curves[0].casts = false;
  EXPECT_NE(key, key_of(other));
  other = fur_scene();
  other.curves[0].local_to_world[3].x = 0.01;
  EXPECT_NE(key, key_of(other));
  // Out of the light's reach they cost nothing.
  other = fur_scene();
  other.curves.push_back(random_fur({50, 0, 4}, 0.5, 10, 3));
  EXPECT_EQ(key, key_of(other));
}

TEST(Curves, PlacementScalesTheirWidths) {
  Scene plain, scaled;
  plain.curves = {one_strand({{0, -2, 4, 0.25F}, {0, 2, 4, 0.25F}})};
  scaled.curves = {one_strand({{0, -1, 0, 0.125F}, {0, 1, 0, 0.125F}})};
  scaled.curves[0].local_to_world = glm::dmat4(2);
  scaled.curves[0].local_to_world[3] = {0, 0, 4, 1};
  for (Scene* scene : {&plain, &scaled}) add(*scene, everywhere(kFar));
  expect_same_bytes(BakedFunctions(plain, square_light(), small_options(64, 64, 9)),
                    BakedFunctions(scaled, square_light(), small_options(64, 64, 9)));
}

TEST(Curves, RefuseWhatIsNone) {
  const auto fault = [](const Curves& curves) -> std::string {
    try {
      check_curves(curves);
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      return error.what();
    }
    return "";
  };
  const glm::vec4 good(0, 0, 1, 0.1F);
  EXPECT_EQ(fault(one_strand({good, {0, 1, 1, 0.2F}})), "");
  for (const glm::vec4& bad : {glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 1, -1), glm::vec4(NAN, 0, 1, 1),
                               glm::vec4(0, HUGE_VALF, 1, 1), glm::vec4(0, 0, 1, NAN)})
    EXPECT_EQ(fault(one_strand({good, bad})), "hair:strands: must have finite points and radii above 0");
  Curves open = one_strand({good});
  EXPECT_EQ(fault(open), "");
  auto strands = std::make_shared<Strands>(*open.strands);
  strands->segments = {0};
  open.strands = strands;
  EXPECT_EQ(fault(open), "hair:strands: has a segment without an end");
  open.strands = nullptr;
  EXPECT_EQ(fault(open), "hair:strands: is missing");
  Curves stretched = one_strand({good, good});
  stretched.local_to_world[1][1] = 2;
  EXPECT_EQ(fault(stretched), "hair:local_to_world: must scale by one factor, not 0");
  Scene scene;
  scene.curves = {stretched};
  EXPECT_THROW((void)bake(scene, square_light(), small_options(8, 8, 1)), Error);
}

TEST(CurveHull, HoldsAllOfEachSegment) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Curves fur = random_fur({1, -2, 30}, 2, 60, seed);
    const CasterHull hull = curve_hull(fur);
    const glm::dmat4 to_lattice = glm::inverse(hull.surface.local_to_world);
    Random random(seed);
    for (const std::uint32_t first : fur.strands->segments) {
      for (int n = 0; n < 20; ++n) {
        const glm::vec4 at = glm::mix(fur.strands->points[first], fur.strands->points[first + 1],
                                      static_cast<float>(random.uniform(0, 1)));
        const glm::dvec3 aside = glm::normalize(
            glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)) + 1e-9);
        const glm::dvec3 p = glm::dvec3(glm::vec3(at)) + static_cast<double>(at.w) * aside;
        const glm::ivec3 cell(glm::floor(glm::dvec3(to_lattice * glm::dvec4(p, 1))));
        ASSERT_NE(std::ranges::find(hull.cells, cell), hull.cells.end());
      }
    }
  }
}

}  // namespace
}  // namespace pdsm::test
