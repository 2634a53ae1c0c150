// SPDX-License-Identifier: Apache-2.0
// Shadow rays before curves, and verify of what is baked of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "evaluate/verify.h"
#include "pdsm/bake/bake.h"
#include "plates.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

constexpr double kRadius = 0.2, kDepth = 3;

Curves bar(CurveShape shape) {
  auto strands = std::make_shared<Strands>();
  for (const float y : {-30.0F, 30.0F})
    strands->points.emplace_back(0, y, static_cast<float>(kDepth), static_cast<float>(kRadius));
  strands->segments = {0};
  return {"bar", strands, glm::dmat4(1.0), shape, true, glm::vec3(1)};
}

/// A jittered grid of n light points misses no more of a strip than two columns of its sqrt(n).
constexpr std::uint32_t kSamples = 65536;
constexpr double kTolerance = 2.0 / 256;

TEST(TruthOfCurves, ATubeHidesAStripAndARibbonItsWidth) {
  for (const CurveShape shape : {CurveShape::round, CurveShape::flat}) {
    Scene scene;
    scene.curves = {bar(shape)};
    const ShadowRays rays(scene, light_at_origin(RectLight{2, 2}), 1);
    for (const double z : {3.5, 4.0, 6.0}) {
      // Tangents to the tube leave under asin(r / d); a ribbon faces each ray, whose distance from its axis
      // tells whether it is met: the same.
      const double half = z * std::tan(std::asin(kRadius / (z - kDepth)));
      EXPECT_NEAR(rays.attenuation({0, 0.1, z}, kSamples, 1), std::min(1.0, half), kTolerance) << z;
    }
  }
}

TEST(TruthOfCurves, CurvesThatDoNotCastAreNotThere) {
  Scene scene;
  scene.curves = {bar(CurveShape::round)};
  scene.curves[0].casts = false;
  const ShadowRays rays(scene, light_at_origin(RectLight{2, 2}), 1);
  EXPECT_EQ(rays.attenuation({0, 0, 5}, 256, 1), 0);
}

TEST(TruthOfCurves, OpaqueBesideTranslucentSurfaces) {
  Scene scene;
  scene.geometry = {plate(-40, -40, 40, 40, 4)};
  scene.geometry[0].opacity = 0.5;
  scene.curves = {bar(CurveShape::round)};
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  EXPECT_EQ(rays.attenuation({0, 0, 5}, 4, 1), 1);
  EXPECT_EQ(rays.attenuation({2, 0, 5}, 4, 1), 0.5);
}

TEST(TruthOfCurves, BakesHoldToIt) {
  Scene scene;
  scene.curves = {bar(CurveShape::round)};
  scene.geometry = {plate(-40, -40, 40, 40, 6)};
  scene.lights = {light_at_origin(RectLight{1, 1})};
  scene.lights[0].window = {-0.3, -0.3, 0.3, 0.3};
  BakeOptions options;
  options.width = options.height = 64;
  VerifyOptions asked;
  asked.points = 400;
  asked.samples = 1024;
  asked.free_space = false;
  const VerifyResult result =
      verify(decode_blocks(bake(scene, scene.lights[0], options)), scene, scene.lights[0], asked);
  EXPECT_GT(result.shadowed_points, 100U);
  // Epsilon .02, sampling of two edges by 256 samples (2 x 2 / 16 strata of which half may err: .06),
  // truth's.
  EXPECT_LT(result.mean_abs_error, 0.02 + 0.5 / 16);
  scene.curves[0].shape = CurveShape::flat;
  EXPECT_LT(verify(decode_blocks(bake(scene, scene.lights[0], options)), scene, scene.lights[0], asked)
                .mean_abs_error,
            0.02 + 0.5 / 16);
}

}  // namespace
}  // namespace pdsm
