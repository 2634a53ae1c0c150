// SPDX-License-Identifier: Apache-2.0
#include "evaluate/verify.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "evaluate/probe_points.h"
#include "plates.h"
#include "truth/solids.h"

namespace pdsm {
namespace {

/// A square light over a plate and a floor.
Scene plate_over_floor() {
  Scene scene;
  scene.lights = {light_at_origin(RectLight{1, 1})};
  scene.geometry = {plate(-0.5, -0.5, 0.5, 0.5, 4), plate(-40, -40, 40, 40, 8)};
  return scene;
}

/// A map of `size` texels whose functions all are the same.
PenumbraMap uniform_map(std::uint32_t size, const std::vector<FunctionVertex>& function) {
  PenumbraMap map;
  View view;
  view.window = {-0.3, -0.3, 0.3, 0.3};
  view.near_depth = 2;
  view.far_depth = 8;
  view.width = view.height = size;
  map.views = {view};
  FunctionImage image;
  image.width = image.height = size;
  FunctionBlock block;
  const std::uint32_t words = map.coding.words_per_vertex();
  for (std::uint32_t texel = 0; texel < size * size; ++texel) {
    block.first.push_back(static_cast<std::uint32_t>(block.words.size()) / words);
    for (const FunctionVertex& vertex : function) {
      block.words.resize(block.words.size() + words);
      pack_vertex(map.coding, vertex, &block.words[block.words.size() - words]);
    }
  }
  block.first.push_back(static_cast<std::uint32_t>(block.words.size()) / words);
  image.blocks = {block};
  map.images = {image};
  return map;
}

VerifyOptions few_points() {
  VerifyOptions options;
  options.points = 400;
  options.samples = 256;
  return options;
}

TEST(Verify, EmptyMapErrsByTheTruth) {
  // V' = 0 everywhere: the error is -V, so bias = -mean_abs_error, and no point errs by more than 1.
  const Scene scene = plate_over_floor();
  const VerifyResult result = verify(uniform_map(8, {}), scene, scene.lights[0], few_points());
  EXPECT_EQ(result.points, 400U);
  EXPECT_EQ(result.surface_points, 200U);
  EXPECT_EQ(result.past_end, 0U);
  EXPECT_GT(result.shadowed_points, 20U);
  EXPECT_LT(result.shadowed_points, 400U);
  EXPECT_GT(result.mean_abs_error, 0.2);
  EXPECT_DOUBLE_EQ(result.bias, -result.mean_abs_error);
  EXPECT_GE(result.rms_error, result.mean_abs_error);
  EXPECT_GE(result.max_error, result.p99_error);
  EXPECT_LE(result.max_error, 1);
  EXPECT_GT(result.truth_standard_error, 0);
  EXPECT_LT(result.truth_standard_error, 0.05);
}

TEST(Verify, FalseShadowCountsInFullAndDilutesNothing) {
  // V' = 1 from near on: a lit point errs by 1. Sum |error| = sum (1 - V) over points behind near.
  const Scene scene = plate_over_floor();
  const PenumbraMap dark = uniform_map(8, {{0, 255, 255}});
  const VerifyResult result = verify(dark, scene, scene.lights[0], few_points());
  const VerifyResult empty = verify(uniform_map(8, {}), scene, scene.lights[0], few_points());
  const auto shadowed = static_cast<double>(empty.shadowed_points);
  const double sum_truth = empty.mean_abs_error * shadowed;
  EXPECT_NEAR(result.mean_abs_error * shadowed, 400 - sum_truth, 1e-6);
  EXPECT_NEAR(result.bias, result.mean_abs_error, 1e-12);
  EXPECT_EQ(result.max_error, 1);
}

TEST(Verify, LitSceneDividesByOne) {
  Scene scene = plate_over_floor();
  scene.geometry.erase(scene.geometry.begin());
  const VerifyResult lit = verify(uniform_map(8, {}), scene, scene.lights[0], few_points());
  EXPECT_EQ(lit.shadowed_points, 0U);
  EXPECT_EQ(lit.mean_abs_error, 0);
  const VerifyResult dark = verify(uniform_map(8, {{0, 255, 255}}), scene, scene.lights[0], few_points());
  EXPECT_NEAR(dark.mean_abs_error, 400, 1e-6);
}

TEST(Verify, CountsPastEnds) {
  const Scene scene = plate_over_floor();
  PenumbraMap map = uniform_map(8, {});
  // The domain ends above the floor: its surface points are past it, those of the plate are not.
  map.images[0].blocks[0].domain_end.assign(64, 0xC000);
  const VerifyResult result = verify(map, scene, scene.lights[0], few_points());
  EXPECT_GT(result.past_end, 150U);
  EXPECT_LE(result.past_end, 200U);
}

TEST(Verify, ThreadsDoNotMatter) {
  const Scene scene = plate_over_floor();
  const int all = omp_get_max_threads();
  omp_set_num_threads(1);
  const VerifyResult one = verify(uniform_map(8, {}), scene, scene.lights[0], few_points());
  omp_set_num_threads(4);
  const VerifyResult four = verify(uniform_map(8, {}), scene, scene.lights[0], few_points());
  omp_set_num_threads(all);
  EXPECT_EQ(one.mean_abs_error, four.mean_abs_error);
  EXPECT_EQ(one.rms_error, four.rms_error);
}

TEST(SurfaceProbes, LieOnReceiversInTheWindow) {
  Scene scene = plate_over_floor();
  const View view = uniform_map(8, {}).views[0];
  std::uint32_t on_plate = 0;
  for (const glm::dvec3& p : surface_probes(scene, {&view, 1}, 1000, 5).points) {
    EXPECT_TRUE(in_window(view, p)) << p.x << " " << p.y << " " << p.z;
    const bool plate = std::abs(p.z - 4) < 1e-6;
    EXPECT_TRUE(plate || std::abs(p.z - 8) < 1e-6) << p.z;
    on_plate += plate ? 1 : 0;
  }
  // By area: the plate has 1 of 1 + 4.8^2 square metres. Five standard deviations of a binomial.
  const double share = 1 / (1 + 4.8 * 4.8);
  EXPECT_NEAR(on_plate, 1000 * share, 5 * std::sqrt(1000 * share));

  scene.geometry[1].receives = false;
  for (const glm::dvec3& p : surface_probes(scene, {&view, 1}, 100, 5).points) EXPECT_NEAR(p.z, 4, 1e-6);
  scene.geometry[0].receives = false;
  EXPECT_TRUE(surface_probes(scene, {&view, 1}, 100, 5).points.empty());
}

TEST(SurfaceProbes, ClosedMeshesFaceTheLight) {
  Scene scene;
  scene.geometry = {sphere({0, 0, 5}, 1, 24)};
  ASSERT_TRUE(scene.geometry[0].mesh->closed);
  const View view = uniform_map(8, {}).views[0];
  const auto farthest = [&] {
    double z = 0;
    for (const glm::dvec3& p : surface_probes(scene, {&view, 1}, 500, 6).points) z = std::max(z, p.z);
    return z;
  };
  // The horizon of a unit sphere seen from 5 m lies at z = 5 - 1/5; a facet of 7.5 degrees may reach beyond.
  EXPECT_LT(farthest(), 4.8 + 0.14);
  EXPECT_GT(farthest(), 4.5);
  // Mirrored, it still does.
  scene.geometry[0] = mirrored(scene.geometry[0]);
  EXPECT_LT(farthest(), 4.8 + 0.14);
  EXPECT_GT(farthest(), 4.5);
}

/// A closed box between two corners.
Geometry box(const glm::vec3& low, const glm::vec3& high) {
  std::vector<glm::vec3> corners;
  for (int n = 0; n < 8; ++n)
    corners.emplace_back(n & 1 ? high.x : low.x, n & 2 ? high.y : low.y, n & 4 ? high.z : low.z);
  return geometry_of(corners, {{0, 2, 3},
                               {0, 3, 1},
                               {4, 5, 7},
                               {4, 7, 6},
                               {0, 1, 5},
                               {0, 5, 4},
                               {2, 6, 7},
                               {2, 7, 3},
                               {0, 4, 6},
                               {0, 6, 2},
                               {1, 3, 7},
                               {1, 7, 5}});
}

TEST(Solids, HoldWhatClosedReceiversEnclose) {
  Scene scene;
  scene.geometry = {box({-1, -1, 4}, {1, 1, 6}), box({0, -1, 5}, {3, 1, 7}), plate(-9, -9, 9, 9, 8)};
  ASSERT_TRUE(scene.geometry[0].mesh->closed);
  const auto hold = [&](double x, double z) { return Solids(scene).hold({x, 0.1, z}); };
  EXPECT_TRUE(hold(-0.5, 5));   // in the first alone
  EXPECT_TRUE(hold(0.5, 5.5));  // in both
  EXPECT_TRUE(hold(2, 6));
  EXPECT_TRUE(hold(-0.999, 4.001));
  EXPECT_FALSE(hold(-0.5, 3.9));
  EXPECT_FALSE(hold(-0.5, 6.5));
  EXPECT_FALSE(hold(2, 7.5));
  EXPECT_FALSE(hold(2, 8.5));  // an open sheet encloses nothing
  // Turned inside out, or received by nothing, a solid holds nothing of its own.
  scene.geometry[1].receives = false;
  EXPECT_FALSE(hold(2, 6));
  EXPECT_TRUE(hold(0.5, 5.5));
  auto turned = std::make_shared<Mesh>(*scene.geometry[0].mesh);
  for (glm::uvec3& t : turned->triangles) std::swap(t.y, t.z);
  scene.geometry[0].mesh = turned;
  EXPECT_FALSE(hold(-0.5, 5));
}

TEST(SurfaceProbes, LeaveOutWhatSolidsBury) {
  // A box that stands in the floor by half: the floor's share of its base, and its lower half, are buried.
  Scene scene;
  scene.geometry = {box({-0.5, -0.5, 5}, {0.5, 0.5, 7}), box({-9, -9, 6}, {9, 9, 8}),
                    plate(-0.4, -0.4, 0.4, 0.4, 5.5)};
  const View view = uniform_map(8, {}).views[0];
  const SurfaceProbes probes = surface_probes(scene, {&view, 1}, 2000, 5);
  ASSERT_EQ(probes.points.size(), 2000U);
  std::uint32_t on_floor = 0;
  for (const glm::dvec3& p : probes.points) {
    const bool in_box = std::abs(p.x) < 0.5 && std::abs(p.y) < 0.5 && p.z > 5 + 1e-6;
    EXPECT_FALSE(in_box) << p.x << " " << p.y << " " << p.z;
    EXPECT_LT(p.z, 6 + 1e-6);
    on_floor += p.z > 6 - 1e-6 ? 1 : 0;
  }
  // By area: 3.6^2 of floor and 1 of roof are seen, a base of 1 and a sheet of 0.64 on it are not. The
  // box's sides are turned away from the light.
  const double floor = 3.6 * 3.6 - 1, seen = floor + 1, share = floor / seen;
  EXPECT_NEAR(on_floor, 2000 * share, 5 * std::sqrt(2000 * share * (1 - share)));
  const double buried = 1.64 / seen;
  EXPECT_NEAR(static_cast<double>(probes.buried), 2000 * buried, 5 * std::sqrt(2000 * buried * (1 + buried)));
  // Of an open sheet, one side in the air is enough.
  scene.geometry = {plate(-0.4, -0.4, 0.4, 0.4, 5), box({-0.5, -0.5, 5}, {0.5, 0.5, 7})};
  EXPECT_EQ(surface_probes(scene, {&view, 1}, 500, 5).buried, 0U);
}

TEST(FreeProbes, FillTheDomain) {
  PenumbraMap map = uniform_map(8, {});
  std::uint32_t deep = 0;
  for (const glm::dvec3& p : free_probes(map, 2000, 7)) {
    EXPECT_TRUE(in_window(map.views[0], p));
    EXPECT_TRUE(p.z >= 2 && p.z <= 8) << p.z;
    deep += p.z > 6 ? 1 : 0;
  }
  const double share = (512.0 - 216.0) / (512.0 - 8.0);  // by volume
  EXPECT_NEAR(deep, 2000 * share, 5 * std::sqrt(2000 * share * (1 - share)));

  // Texel (i, j) ends at its own depth.
  map.images[0].blocks[0].domain_end.assign(64, 0x8000);
  map.images[0].blocks[0].domain_end[0] = 0xFFFF;
  EXPECT_NEAR(domain_end(map, 0, 1, 0), 5, 1e-3);
  EXPECT_EQ(domain_end(map, 0, 0, 0), 8);
  for (const glm::dvec3& p : free_probes(map, 500, 8)) {
    const bool first = p.x / p.z < -0.225 && p.y / p.z < -0.225;
    EXPECT_LE(p.z, first ? 8 : 5.0001);
  }
}

}  // namespace
}  // namespace pdsm
