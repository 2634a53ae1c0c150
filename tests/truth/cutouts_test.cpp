// SPDX-License-Identifier: Apache-2.0
// Truth, pictures and probes see through holes; verify holds bakes of foliage to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "evaluate/picture_scene.h"
#include "evaluate/probe_points.h"
#include "evaluate/verify.h"
#include "pdsm/format/error.h"
#include "plates.h"
#include "truth/cutout_surface.h"
#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

CutoutMask make_mask(std::uint32_t width, std::uint32_t height,
                     const std::function<bool(std::uint32_t, std::uint32_t)>& is_solid) {
  CutoutMask mask{width, height, {}, {}, 0.5F};
  for (std::uint32_t j = 0; j < height; ++j)
    for (std::uint32_t i = 0; i < width; ++i) mask.alpha.push_back(is_solid(i, j) ? 255 : 0);
  return mask;
}

/// plate() with a mask, whose place (0, 0) is at the corner (x0, y0).
Geometry cut_plate(double x0, double y0, double x1, double y1, double z, const CutoutMask& mask,
                   float copies = 1) {
  Geometry geometry = plate(x0, y0, x1, y1, z);
  auto mesh = std::make_shared<Mesh>(*geometry.mesh);
  mesh->mask = std::make_shared<const CutoutMask>(mask);
  mesh->mask_places = {{0, 0}, {copies, 0}, {copies, copies}, {0, copies}};
  geometry.mesh = mesh;
  return geometry;
}

/// A hole of 6 x 8 texels in 16 x 16; each texel is half a metre.
const CutoutMask kHole =
    make_mask(16, 16, [](std::uint32_t i, std::uint32_t j) { return i < 4 || i >= 10 || j < 6 || j >= 14; });

TEST(CutoutSurface, AlphaIsLinearBetweenTexelCentres) {
  const CutoutMask mask{2, 1, {0, 255}, {MaskWrap::clamp, MaskWrap::clamp}, 0.25F};
  // Alpha is 0 up to u = 1/4, then 2 (u - 1/4), 1 from u = 3/4 on.
  for (const double u : {-5.0, 0.0, 0.2, 0.374}) EXPECT_TRUE(is_hole(mask, {u, 0.5})) << u;
  for (const double u : {0.376, 0.7, 1.0, 9.0}) EXPECT_FALSE(is_hole(mask, {u, 0.5})) << u;
}

TEST(CutoutSurface, WrapModes) {
  CutoutMask mask{4, 1, {255, 0, 0, 0}, {MaskWrap::repeat, MaskWrap::repeat}, 0.5F};
  const auto solid = [&](double u) { return !is_hole(mask, {u, 0.5}); };
  for (const double copy : {-3.0, 0.0, 1.0, 1e6}) {
    EXPECT_TRUE(solid(copy + 0.125)) << copy;
    EXPECT_TRUE(solid(copy + 0.01)) << copy;
    EXPECT_FALSE(solid(copy - 0.01)) << copy;
    EXPECT_FALSE(solid(copy + 0.4)) << copy;
  }
  mask.wrap[0] = MaskWrap::mirror;
  for (const double copy : {-4.0, 0.0, 2.0, 1e6}) {
    EXPECT_TRUE(solid(copy + 0.24)) << copy;
    EXPECT_TRUE(solid(copy - 0.24)) << copy;
    EXPECT_FALSE(solid(copy + 0.26)) << copy;
    EXPECT_FALSE(solid(copy + 0.99)) << copy;
    EXPECT_FALSE(solid(copy + 1.01)) << copy;
  }
  mask.wrap[0] = MaskWrap::clamp;
  EXPECT_TRUE(solid(-7));
  EXPECT_FALSE(solid(7));
}

TEST(CutoutSurface, ACutoffOfOneLeavesWhatIsOpaque) {
  const CutoutMask mask{3, 3, std::vector<std::uint8_t>(9, 255), {}, 1};
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const auto [u, v] = hash_unit_pair(5, n);
    EXPECT_FALSE(is_hole(mask, {u, v})) << u << " " << v;
  }
}

/// Through the hole [-2, 1] x [-1, 3] at half of the depth, a point sees twice that of the light's plane: of
/// a light of 2 x 2 m a share, by n x n strata of which a convex outline crosses 4 n - 4 (numerics, section
/// 3). Its corners are round within a quarter of a metre of texels' half size, times 2 in the light's plane.
TEST(TruthOfCutouts, ARectLightThroughAHole) {
  Scene scene;
  scene.geometry = {cut_plate(-4, -4, 4, 4, 5, kHole)};
  const Light light = light_at_origin(RectLight{2, 2});
  const ShadowRays rays(scene, light, 1);
  constexpr std::uint32_t kStrata = 64;
  const double outline = std::sqrt((4 * kStrata - 4) * std::log(2 / 1e-9) / 2) / (kStrata * kStrata);
  for (const glm::dvec2 at : {glm::dvec2(0, 0), {-4, 1}, {-3.6, 4}, {2.7, -2}, {1.2, 6.5}, {5, 5}}) {
    double open = 1;
    bool corner = true;
    const glm::dvec2 low(-2, -1), high(1, 3);
    for (int a = 0; a < 2; ++a) {
      const double from = 2 * low[a] - at[a], to = 2 * high[a] - at[a];
      open *= std::max(0.0, std::min(to, 1.0) - std::max(from, -1.0)) / 2;
      corner = corner && ((from > -1 && from < 1) || (to > -1 && to < 1));
    }
    const double round = corner ? 0.5 * 0.5 / 4 : 0;
    EXPECT_NEAR(rays.attenuation({at.x, at.y, 10}, kStrata * kStrata, 3), 1 - open, outline + round) << at.x;
  }
}

/// Triangles that the emitter hides are left out, and those behind them keep their places in the mask.
TEST(TruthOfCutouts, TrianglesBehindOthersThatAreLeftOut) {
  Scene scene;
  scene.geometry = {cut_plate(-4, -4, 4, 4, 5, kHole)};
  auto mesh = std::make_shared<Mesh>(*scene.geometry[0].mesh);
  const auto first = static_cast<std::uint32_t>(mesh->positions.size());
  for (const float x : {0.0F, 1.0F, 2.0F}) {
    mesh->positions.emplace_back(x, x * x, -1);
    mesh->mask_places.emplace_back(0.9F, 0.9F);
  }
  mesh->triangles.insert(mesh->triangles.begin(), {first, first + 1, first + 2});
  scene.geometry[0].mesh = mesh;
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  EXPECT_EQ(rays.attenuation({-1, 2, 10}, 16, 1), 0);
  EXPECT_EQ(rays.attenuation({-5, 2, 10}, 16, 1), 1);
  EXPECT_EQ(rays.attenuation({3, 2, 10}, 16, 1), 1);
}

TEST(TruthOfCutouts, PicturesShowWhatIsBehind) {
  Scene scene;
  scene.geometry = {cut_plate(-4, -4, 4, 4, 5, kHole), plate(-9, -9, 9, 9, 8)};
  const PictureScene picture(scene);
  EXPECT_NEAR(picture.trace({-0.5, 1, 0}, {0, 0, 1})->position.z, 8, 1e-5);
  EXPECT_NEAR(picture.trace({-3, 1, 0}, {0, 0, 1})->position.z, 5, 1e-5);
  EXPECT_TRUE(picture.sees({-0.5, 1, 0}, {-0.5, 1, 7}));
  EXPECT_FALSE(picture.sees({-3, 1, 0}, {-3, 1, 7}));
}

TEST(TruthOfCutouts, ProbesLieOnWhatIsThere) {
  Scene scene;
  scene.geometry = {cut_plate(-4, -4, 4, 4, 5, kHole)};
  View view;
  view.window = {-1, -1, 1, 1};
  view.near_depth = 1;
  view.far_depth = 6;
  const SurfaceProbes probes = surface_probes(scene, {&view, 1}, 500, 7);
  ASSERT_EQ(probes.points.size(), 500U);
  for (const glm::dvec3& p : probes.points)
    EXPECT_TRUE(is_hole(kHole, (glm::dvec2(p) + 4.0) / 8.0) == false) << p.x << " " << p.y;
}

TEST(TruthOfCutouts, MasksThatMakeNoSenseAreRefused) {
  Scene scene;
  CutoutMask mask = kHole;
  mask.alpha.pop_back();
  scene.geometry = {cut_plate(-4, -4, 4, 4, 5, mask)};
  EXPECT_THROW(ShadowRays(scene, light_at_origin(RectLight{1, 1}), 1), Error);
}

/// Leaves between a wide light and a floor: some with mask texels much larger than a map's, some much
/// smaller.
Scene foliage() {
  const CutoutMask leaf = make_mask(32, 32, [](std::uint32_t i, std::uint32_t j) {
    const double x = i + 0.5 - 16, y = j + 0.5 - 16;
    return x * x + y * y < 14 * 14;
  });
  Scene scene;
  for (std::uint64_t n = 0; n < 60; ++n) {
    const auto [x, y] = hash_unit_pair(11, n);
    const double z = 3 + 1.5 * hash_unit(12, n), size = n % 2 == 0 ? 0.8 : 0.4;
    scene.geometry.push_back(cut_plate(4 * x - 2.4, 4 * y - 2.4, 4 * x - 2.4 + size, 4 * y - 2.4 + size, z,
                                       leaf, n % 4 == 1 ? 20.0F : 1.0F));
    scene.geometry.back().receives = false;
  }
  scene.geometry.push_back(plate(-9, -9, 9, 9, 8));
  return scene;
}

/// Of N light samples each sees a point or not. Were they drawn one by one, the mean of |error| would be
/// sqrt(V (1 - V) / N) <= 1 / (2 sqrt(N)) at most; strata and lattices do no worse. The fit adds epsilon at
/// most. A texel of 8/100 m on the floor, where penumbrae of leaves are 1.5 (8 - 4.5) / 4.5 = 1.2 m wide at
/// the least, makes a look-up of four err by at most half of a texel's share of one: 0.035.
TEST(TruthOfCutouts, BakesOfFoliageHoldToIt) {
  Scene scene = foliage();
  Light light = light_at_origin(RectLight{1.5, 1.5});
  light.window = {-0.5, -0.5, 0.5, 0.5};
  scene.lights = {light};
  BakeOptions options = small_options();
  options.width = options.height = 100;
  options.samples = 256;
  const BakedMap baked = bake(scene, light, options);
  VerifyOptions wanted;
  wanted.points = 1000;
  wanted.samples = 1024;
  const VerifyResult result = verify(decode_blocks(baked), scene, light, wanted);
  EXPECT_GT(result.shadowed_points, 500U);
  EXPECT_LT(result.mean_abs_error, 0.5 / std::sqrt(256.0) + options.epsilon + 0.035);
  // False light or shadow anywhere would show as a bias, of which there is no cause.
  EXPECT_LT(std::abs(result.bias), 0.5 * (0.5 / std::sqrt(256.0)));
}

}  // namespace
}  // namespace pdsm
