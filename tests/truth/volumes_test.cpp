// SPDX-License-Identifier: Apache-2.0
// Shadow rays through volumes against closed forms, and bakes against shadow rays.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "../bake/support/volumes.h"
#include "evaluate/verify.h"
#include "evaluate/volume_picture.h"
#include "pdsm/bake/bake.h"
#include "plates.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

using test::Slab;

constexpr double kRounding = 1e-6;  // of the rays' float directions

/// A light that is a point: one ray stands for all.
double truth_by_a_point(const Scene& scene, const glm::dvec3& point) {
  return ShadowRays(scene, light_at_origin(RectLight{0, 0}), 1).attenuation(point, 16, 1);
}

/// A ray leaves its point at 1e-4 of its length, which may be in the volume.
double start(const glm::dvec3& point, double extinction) {
  return 1e-4 * glm::length(point) * extinction;
}

TEST(TruthOfVolumes, ASlabIsItsClosedForm) {
  const Slab slab;
  Scene scene;
  for (const double extinction : {0.3, 2.0}) {
    scene.volumes = {slab.volume(extinction)};
    for (const glm::dvec3& p :
         {glm::dvec3(0, 0, 2.9), {0.3, 0.1, 3.1}, {1, -2, 3.7}, {-1, 0.5, 4.9}, {2, 2, 9}})
      EXPECT_NEAR(truth_by_a_point(scene, p),
                  1 - std::exp(-extinction * slab.integral(p.z) * glm::length(p) / p.z),
                  start(p, extinction) + kRounding)
          << p.z;
  }
}

TEST(TruthOfVolumes, WhatElseTakesLightMultiplies) {
  const Slab slab, deeper{3.6, 0.4, 3};
  Scene scene;
  scene.volumes = {slab.volume(1), deeper.volume(0.5)};
  scene.geometry = {plate(-40, -40, 40, 40, 6), plate(-40, -40, 40, 40, 8)};
  scene.geometry[0].opacity = 0.3;
  const auto kept = [&](double z) { return std::exp(-slab.integral(z) - 0.5 * deeper.integral(z)); };
  for (const double z : {3.5, 4.4, 5.5})
    EXPECT_NEAR(truth_by_a_point(scene, {0, 0, z}), 1 - kept(z), 1e-3) << z;
  EXPECT_NEAR(truth_by_a_point(scene, {0, 0, 7}), 1 - 0.7 * kept(7), kRounding);
  EXPECT_EQ(truth_by_a_point(scene, {0, 0, 9}), 1);
}

/// A density that is linear along two axes, where trilinear interpolation is exact, on a lattice that is
/// turned and stretched; over many bricks.
TEST(TruthOfVolumes, TurnedAndStretched) {
  Volume volume;
  volume.name = "wedge";
  volume.grid =
      test::make_grid({-40, -40, -40}, {40, 40, 40}, [](int x, int, int z) { return 100 + x + 0.5 * z; });
  volume.index_to_world = glm::dmat4(glm::dvec4(0, 0.05, 0.1, 0), glm::dvec4(0.2, 0, 0, 0),
                                     glm::dvec4(0, 0.1, -0.05, 0), glm::dvec4(0, 0, 6, 1));
  volume.extinction = 0.01;
  Scene scene;
  scene.volumes = {volume};
  const glm::dmat4 to_index = glm::inverse(volume.index_to_world);
  // Between these depths all of the rays are within the lattice.
  for (const glm::dvec3& slope : {glm::dvec3(0, 0, 1), {0.1, 0.05, 1}, {-0.2, 0.1, 1}}) {
    const auto along = [&](double z) {
      const glm::dvec4 p = to_index * glm::dvec4(slope * z, 1);
      return 100 + p.x + 0.5 * p.z;
    };
    const double before = -std::log1p(-truth_by_a_point(scene, slope * 5.0)),
                 behind = -std::log1p(-truth_by_a_point(scene, slope * 7.0));
    const double exact = 0.01 * glm::length(slope) * 2 * (along(5) + along(7)) / 2;
    EXPECT_NEAR(behind - before, exact, 2 * 1e-4 * 7 * 1.5);
  }
}

/// Light from a square through fog: the mean over the light, by a fine sum.
TEST(TruthOfVolumes, TheWholeLightCounts) {
  const Slab slab;
  Scene scene;
  scene.volumes = {slab.volume(1)};
  const glm::dvec3 p(0.5, 0, 6);
  double mean = 0;
  constexpr int kEdge = 64;
  for (int n = 0; n < kEdge * kEdge; ++n) {
    const glm::dvec3 s((n % kEdge + 0.5) / kEdge * 2 - 1, (n / kEdge + 0.5) / kEdge * 2 - 1, 0);
    mean += std::exp(-slab.integral(6) * glm::length(p - s) / 6) / (kEdge * kEdge);
  }
  EXPECT_NEAR(ShadowRays(scene, light_at_origin(RectLight{2, 2}), 1).attenuation(p, 1024, 1), 1 - mean, 1e-3);
}

/// Two implementations that share no line: a bake's look-ups against shadow rays. What may be off is epsilon,
/// steps as if of independent rays, and 0.01 for maps of 96 texels.
TEST(VerifyOfVolumes, ABakeIsAsCloseAsItsSettingsPromise) {
  Scene scene;
  Volume ball;
  ball.name = "ball";
  ball.grid = test::make_grid({-10, -10, -10}, {10, 10, 10}, [](int x, int y, int z) {
    return std::max(0.0, 1 - std::sqrt(x * x + y * y + z * z) / 10);
  });
  ball.index_to_world = test::scaled_and_moved({0.08, 0.1, 0.08}, {0.1, 0, 4});
  ball.extinction = 3;
  scene.volumes = {ball};
  scene.geometry = {plate(-3, -3, 3, 3, 6)};
  const Light light = light_at_origin(RectLight{1, 1});
  BakeOptions options;
  options.samples = 64;
  options.width = options.height = 96;
  options.epsilon = 0.01;
  const PenumbraMap map = decode_blocks(bake(scene, light, options));
  VerifyOptions verify_options;
  verify_options.points = 400;
  verify_options.samples = 256;
  const VerifyResult result = verify(map, scene, light, verify_options);
  EXPECT_GT(result.shadowed_points, 100U);
  EXPECT_LT(result.mean_abs_error, 0.01);
  EXPECT_LT(std::abs(result.bias), 0.005);
}

/// Under even light, what is scattered is one share of what is taken, and what is behind keeps the rest.
TEST(PictureOfVolumes, ScatteredAndLeftAreAllThereIs) {
  const Slab slab;
  const auto seen = [&](double extinction, double distance, float behind) {
    Scene scene;
    scene.volumes = {slab.volume(extinction)};
    return VolumePicture(scene)
        .over({0, 0, 0}, {0, 0, 1}, distance, glm::vec3(behind),
              [](const glm::dvec3&) { return glm::vec3(1); })
        .x;
  };
  const float opaque = seen(100, 9, 0);
  EXPECT_GT(opaque, 0.3F);
  for (const double extinction : {0.2, 1.0, 3.0}) {
    const auto kept = static_cast<float>(std::exp(-extinction * slab.integral(9)));
    // What is behind 1 / 512 of the light is not looked for.
    EXPECT_NEAR(seen(extinction, 9, 0), opaque * (1 - kept), 1.0 / 256);
    EXPECT_NEAR(seen(extinction, 9, 2) - seen(extinction, 9, 0), 2 * kept, 1e-5);
    EXPECT_EQ(seen(extinction, 2.5, 0.5F), 0.5F);
    EXPECT_LT(seen(extinction, 4, 0), seen(extinction, 9, 0));
  }
}

}  // namespace
}  // namespace pdsm
