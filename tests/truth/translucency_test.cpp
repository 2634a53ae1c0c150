// SPDX-License-Identifier: Apache-2.0
// Shadow rays go on behind translucent surfaces, and verify holds bakes of them to that.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "evaluate/verify.h"
#include "pdsm/bake/bake.h"
#include "plates.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

Geometry sheet(double x0, double y0, double x1, double y1, double z, double opacity) {
  Geometry geometry = plate(x0, y0, x1, y1, z);
  geometry.opacity = opacity;
  return geometry;
}

TEST(TruthOfTranslucency, LayersMultiplyUpToAnOpaqueOne) {
  Scene scene;
  scene.geometry = {sheet(-40, -40, 40, 40, 3, 0.3), sheet(-40, -40, 40, 40, 5, 0.5),
                    plate(-40, -40, 40, 40, 8), sheet(-40, -40, 40, 40, 9, 0)};
  const ShadowRays rays(scene, light_at_origin(RectLight{2, 2}), 1);
  for (const auto& [z, expected] : {std::pair{2.0, 0.0}, {4.0, 0.3}, {7.0, 0.65}, {10.0, 1.0}})
    EXPECT_NEAR(rays.attenuation({0.3, 0.1, z}, 64, 1), expected, 1e-12) << z;
}

/// The plate's diagonal is in the way of each ray from a point on it to a light that is a point on it.
TEST(TruthOfTranslucency, AnEdgeBetweenTrianglesCountsOnce) {
  Scene scene;
  scene.geometry = {sheet(-4, -4, 4, 4, 5, 0.5)};
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  for (const double at : {-2.0, -1.0, 0.0, 0.5, 3.0})
    EXPECT_EQ(rays.attenuation({at, at, 10}, 4, 1), 0.5) << at;
}

TEST(TruthOfTranslucency, AMaskThatBlendsIsTheOpacity) {
  CutoutMask mask{4, 1, {51, 51, 204, 204}, {MaskWrap::clamp, MaskWrap::clamp}, 0.5F, true};
  Scene scene;
  scene.geometry = {sheet(-4, -4, 4, 4, 5, 0.5)};
  auto mesh = std::make_shared<Mesh>(*scene.geometry[0].mesh);
  mesh->mask = std::make_shared<const CutoutMask>(mask);
  mesh->mask_places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.geometry[0].mesh = mesh;
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  EXPECT_NEAR(rays.attenuation({-5, 1, 10}, 4, 1), 0.5 * 0.2, 1e-7);
  EXPECT_NEAR(rays.attenuation({5, 1, 10}, 4, 1), 0.5 * 0.8, 1e-7);
  EXPECT_NEAR(rays.attenuation({0, 1, 10}, 4, 1), 0.5 * 0.5, 1e-7);
}

TEST(TruthOfTranslucency, StainedGlassPerChannel) {
  Scene scene;
  scene.geometry = {plate(-40, -40, 40, 40, 3), plate(-40, -40, 40, 40, 5)};
  scene.geometry[0].transmission = {0.9, 0.25, 0};
  scene.geometry[1].transmission = {0.5, 0.5, 1};
  scene.geometry[1].opacity = 0.8;
  const ShadowRays rays(scene, light_at_origin(RectLight{2, 2}), 1);
  ASSERT_TRUE(rays.is_coloured());
  const auto behind_one = rays.rgb({0.3, 0.1, 4}, 64, 1), behind_both = rays.rgb({0.3, 0.1, 7}, 64, 1);
  const std::array<double, 3> one{0.1, 0.75, 1}, both{1 - 0.9 * 0.6, 1 - 0.25 * 0.6, 1};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(behind_one[channel], one[channel], 1e-12) << channel;
    EXPECT_NEAR(behind_both[channel], both[channel], 1e-12) << channel;
  }
  EXPECT_NEAR(rays.attenuation({0.3, 0.1, 4}, 64, 1), 0.2126 * 0.1 + 0.7152 * 0.75 + 0.0722, 1e-12);
}

TEST(TruthOfTranslucency, GlassOfAPictureHasItsColours) {
  CutoutMask mask{2, 1, {255, 51}, {MaskWrap::clamp, MaskWrap::clamp}, 0, true};
  mask.transmission = {{255, 51, 0}, {255, 51, 0}};
  Scene scene;
  scene.geometry = {plate(-4, -4, 4, 4, 5)};
  scene.geometry[0].transmission = {1, 0.5, 0.5};
  auto mesh = std::make_shared<Mesh>(*scene.geometry[0].mesh);
  mesh->mask = std::make_shared<const CutoutMask>(mask);
  mesh->mask_places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.geometry[0].mesh = mesh;
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  // Masks are rounded to 8 bits.
  const double rounding = 0.5 / 255 + 1e-7;
  for (const auto& [x, alpha] : {std::pair{-5.0, 1.0}, {5.0, 0.2}}) {
    const auto [red, green, blue] = rays.rgb({x, 1, 10}, 4, 1);
    EXPECT_NEAR(red, 0, rounding) << x;
    EXPECT_NEAR(green, alpha * 0.9, rounding) << x;
    EXPECT_NEAR(blue, alpha, rounding) << x;
  }
}

TEST(TruthOfTranslucency, VerifyTakesTheChannelThatIsFarthestOff) {
  Scene scene;
  scene.geometry = {plate(-40, -40, 40, 40, 3), plate(-40, -40, 40, 40, 8)};
  scene.geometry[0].transmission = {0.9, 0.25, 0};
  scene.geometry[0].receives = false;
  scene.lights = {light_at_origin(RectLight{1, 1})};
  BakeOptions options;
  options.width = options.height = 16;
  options.samples = 16;
  options.receivers = Receivers::surfaces;
  const PenumbraMap map = decode_blocks(bake(scene, scene.lights[0], options));
  VerifyOptions asked;
  asked.points = 50;
  asked.samples = 16;
  asked.free_space = false;
  // All of the floor is behind the pane: the map is off by its epsilon and the rounding of values alone.
  EXPECT_LE(verify(map, scene, scene.lights[0], asked).max_error, options.epsilon + 1e-9);
  scene.geometry[0].transmission = {0.9, 0.25, 0.5};
  const VerifyResult changed = verify(map, scene, scene.lights[0], asked);
  EXPECT_NEAR(changed.mean_abs_error, 0.5, options.epsilon + 1e-9);
  EXPECT_NEAR(changed.bias, 0.5, options.epsilon + 1e-9);
}

}  // namespace
}  // namespace pdsm
