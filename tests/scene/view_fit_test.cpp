// SPDX-License-Identifier: Apache-2.0
// Fitted views against plates whose shadows are known in closed form.
#include "pdsm/bake/view_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "pdsm/format/error.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

using Window = std::array<double, 4>;

// What the fit adds around window, near and far, and a little for rounding.
constexpr double kPad = 4e-6;

void expect_window(const Window& actual, const Window& expected, double tolerance = kPad) {
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "side " << i;
}

/// The plate scene: a light of 2 x 1 at height 6, a plate of 1.2 x 0.8 at height 2.5, a floor of 20 x 20.
/// In light space x is world x, y is world z and depth is 6 - world y.
Scene plate_scene() {
  Scene scene;
  scene.geometry = {placed(plate_mesh(1.2, 0.8), {0.2, 2.5, -0.1}), placed(plate_mesh(20, 20), {0, 0, 0})};
  return scene;
}

Light plate_light() {
  return lamp_above({0, 6, 0}, 2, 1);
}

// Shadow slopes of an edge at p, depth 3.5, on the floor at depth 6: p / 3.5 ± h (1 / 3.5 - 1 / 6).
const double kReach = 1 / 3.5 - 1 / 6.0;
const Window kPlateShadow{-0.4 / 3.5 - kReach, -0.5 / 3.5 - 0.5 * kReach, 0.8 / 3.5 + kReach,
                          0.3 / 3.5 + 0.5 * kReach};

TEST(ViewFit, PlateOverFloor) {
  const FittedView fitted = fit_view(plate_scene(), plate_light(), 640, 480);
  expect_window(fitted.view.window, kPlateShadow);
  EXPECT_NEAR(fitted.view.near_depth, 3.5, 3.5 * kPad);
  EXPECT_LT(fitted.view.near_depth, 3.5);
  EXPECT_NEAR(fitted.view.far_depth, 6, 6 * kPad);
  EXPECT_GT(fitted.view.far_depth, 6);
  EXPECT_TRUE(fitted.window_fitted && fitted.near_fitted && fitted.far_fitted);
  EXPECT_FALSE(fitted.nothing_casts);
  EXPECT_EQ(fitted.view.width, 640U);
  EXPECT_EQ(fitted.view.height, 480U);
  EXPECT_EQ(fitted.view.projection, Projection::perspective);
  const Window& w = kPlateShadow;
  const double floor_inside = (w[2] - w[0]) * (w[3] - w[1]) * 36, plate = 1.2 * 0.8;
  EXPECT_NEAR(fitted.receivers_outside, 1 - (floor_inside + plate) / (400 + plate), 1e-5);
}

TEST(ViewFit, BorderOfTheShadowIsInside) {
  const Window& w = fit_view(plate_scene(), plate_light(), 1, 1).view.window;
  EXPECT_LT(w[0], kPlateShadow[0] - 1e-7);
  EXPECT_LT(w[1], kPlateShadow[1] - 1e-7);
  EXPECT_GT(w[2], kPlateShadow[2] + 1e-7);
  EXPECT_GT(w[3], kPlateShadow[3] + 1e-7);
}

/// The plate scene in a sun of 60 degrees from straight above: shadows reach (2.5 m) tan 30 beside the plate.
TEST(ViewFit, DistantLightOverPlateAndFloor) {
  Light sun = plate_light();
  sun.shape = DistantLight{60};
  const FittedView fitted = fit_view(plate_scene(), sun, 64, 64);
  const double reach = 2.5 * std::tan(std::numbers::pi / 6);
  expect_window(fitted.view.window, {-0.4 - reach, -0.5 - reach, 0.8 + reach, 0.3 + reach});
  EXPECT_EQ(fitted.view.projection, Projection::orthographic);
  EXPECT_NEAR(fitted.view.near_depth, 3.5, 3.5 * kPad);
  EXPECT_NEAR(fitted.view.far_depth, 6, 6 * kPad);
  const double inside = (1.2 + 2 * reach) * (0.8 + 2 * reach), plate = 1.2 * 0.8;
  EXPECT_NEAR(fitted.receivers_outside, 1 - (inside + plate) / (400 + plate), 1e-5);
}

/// What casts into a given window may lie beside it, by up to the way to the deepest receiver times tan 30;
/// and as near as it likes, for a distant light has no emitter in the scene.
TEST(ViewFit, DistantLightFindsCastersThatSlantIntoItsWindow) {
  Light sun = plate_light();
  sun.shape = DistantLight{60};
  sun.window = {-1, -1, 1, 1};
  const double beside = (6 - 1e-5) * std::tan(std::numbers::pi / 6);
  for (const double x : {beside - 0.02, beside + 0.02}) {
    Scene scene;
    scene.geometry = {placed(plate_mesh(0.02, 0.02), {1 + x, 6 - 1e-5, 0}),
                      placed(plate_mesh(20, 20), {0, 0, 0})};
    const FittedView fitted = fit_view(scene, sun, 8, 8);
    EXPECT_EQ(fitted.nothing_casts, x > beside) << x;
    if (!fitted.nothing_casts) {
      EXPECT_NEAR(fitted.view.near_depth, 1e-5, 1e-10);
    }
  }
}

TEST(ViewFit, DiskCountsAsItsSquareAndAPointAsNothing) {
  Light light = plate_light();
  light.shape = DiskLight{1};
  expect_window(fit_view(plate_scene(), light, 1, 1).view.window,
                {-0.4 / 3.5 - kReach, -0.5 / 3.5 - kReach, 0.8 / 3.5 + kReach, 0.3 / 3.5 + kReach});
  light.shape = DiskLight{0};
  expect_window(fit_view(plate_scene(), light, 1, 1).view.window,
                {-0.4 / 3.5, -0.5 / 3.5, 0.8 / 3.5, 0.3 / 3.5});
}

TEST(ViewFit, WindowIsCutToTheReceivers) {
  Scene scene = plate_scene();
  // The receiver is an island under the right half of the shadow.
  scene.geometry[1] = placed(plate_mesh(1, 20), {1.5, 0, 0});
  scene.geometry[0].receives = false;
  expect_window(fit_view(scene, plate_light(), 1, 1).view.window,
                {1.0 / 6, kPlateShadow[1], std::min(2.0 / 6, kPlateShadow[2]), kPlateShadow[3]});
}

TEST(ViewFit, WindowIsAtMost120Degrees) {
  Scene scene;
  scene.geometry = {placed(plate_mesh(100, 100), {0, 5, 0}), placed(plate_mesh(1000, 1000), {0, 0, 0})};
  const double t = std::tan(std::numbers::pi / 3);
  expect_window(fit_view(scene, plate_light(), 1, 1).view.window, {-t, -t, t, t}, 1e-15);
}

TEST(ViewFit, FloorAloneCastsNothing) {
  Scene scene;
  scene.geometry = {placed(plate_mesh(6, 3), {1, 0, 0})};
  const FittedView fitted = fit_view(scene, plate_light(), 1, 1);
  EXPECT_TRUE(fitted.nothing_casts);
  expect_window(fitted.view.window, {-2 / 6.0, -1.5 / 6, 4 / 6.0, 1.5 / 6});
  EXPECT_LT(fitted.view.near_depth, fitted.view.far_depth);
  EXPECT_GT(fitted.view.near_depth, 0);
  EXPECT_EQ(fitted.receivers_outside, 0);
}

TEST(ViewFit, CastersThatDoNotCastAreNotFitted) {
  Scene scene = plate_scene();
  scene.geometry[0].casts = false;
  EXPECT_TRUE(fit_view(scene, plate_light(), 1, 1).nothing_casts);
}

TEST(ViewFit, TiltedFloorDoesNotWidenTheWindow) {
  // Seen by a slanted light, a floor has casters before receivers, but none that can darken them.
  Scene scene = plate_scene();
  scene.geometry.push_back(placed(box_mesh({20, 0.5, 20}), {0, -0.25 - 1e-9, 0}));
  Light light = plate_light();
  light.position = {-3, 6, 0};
  light.direction = {3, -6, 0};
  light.up = glm::dvec3(0, 0, 1);
  const FittedView with_floor = fit_view(scene, light, 1, 1);
  scene.geometry[1].casts = scene.geometry[2].casts = false;
  const FittedView without = fit_view(scene, light, 1, 1);
  expect_window(with_floor.view.window, without.view.window, 1e-12);
  EXPECT_LT(with_floor.view.window[2] - with_floor.view.window[0], 0.6);
}

TEST(ViewFit, FloorWithSomethingBelowDoesWidenTheWindow) {
  Scene scene = plate_scene();
  scene.geometry.push_back(placed(plate_mesh(18, 18), {0, -2, 0}));
  const Window& w = fit_view(scene, plate_light(), 1, 1).view.window;
  // The floor's shadow reaches past all receivers, of which the floor is the widest.
  EXPECT_NEAR(w[2], 10 / 6.0, kPad);
}

TEST(ViewFit, NearestCasterInTheHullCountsThoughOutsideTheWindow) {
  // The plate at depth 1 and x 0.8 .. 1 is outside of the window (|x| <= 0.36 there), but between the light's
  // right end and the window's left part. Hull at depth 1: x up to 0.36 + 1 (1 - 1 / 6) = 1.193.
  Scene scene = plate_scene();
  Light light = plate_light();
  light.window = Window{-0.36, -0.28, 0.36, 0.28};
  scene.geometry.push_back(placed(plate_mesh(0.2, 0.2), {0.9, 5, 0}));
  EXPECT_NEAR(fit_view(scene, light, 1, 1).view.near_depth, 1, kPad);
  // Beyond the hull it does not count: the plate of depth 3.5 is the nearest.
  scene.geometry.back() = placed(plate_mesh(0.2, 0.2), {1.3, 5, 0});
  EXPECT_NEAR(fit_view(scene, light, 1, 1).view.near_depth, 3.5, 3.5 * kPad);
  // A slanted one counts from where it enters the hull: from x = 0 at depth 3 to x = 3 at depth 0 it stays
  // on x = 3 - z, and meets x = 0.36 z + 1 - z / 6 at z = 2 / (1.36 - 1 / 6).
  glm::dmat4 slant(1.0);
  slant[0] = {3, 3, 0, 0};
  slant[3] = {1.5, 4.5, 0, 1};
  scene.geometry.back() = placed(plate_mesh(1, 0.2), slant);
  EXPECT_NEAR(fit_view(scene, light, 1, 1).view.near_depth, 2 / (1.36 - 1 / 6.0), 4 * kPad);
}

TEST(ViewFit, CasterThroughTheLightGivesTheLeastNear) {
  Scene scene = plate_scene();
  scene.geometry.push_back(placed(box_mesh({0.1, 1, 0.1}), {0.3, 6, 0.2}));
  const FittedView fitted = fit_view(scene, plate_light(), 1, 1);
  EXPECT_NEAR(fitted.view.near_depth, 6e-4, 1e-8);
}

TEST(ViewFit, WhatIsBehindTheLightDoesNotMatter) {
  Scene scene = plate_scene();
  const FittedView before = fit_view(scene, plate_light(), 1, 1);
  scene.geometry.push_back(placed(box_mesh({5, 1, 5}), {0, 7, 0}));
  scene.geometry.push_back(placed(plate_mesh(5, 5), {0, 6, 0}));
  const FittedView after = fit_view(scene, plate_light(), 1, 1);
  EXPECT_EQ(after.view.window, before.view.window);
  EXPECT_EQ(after.view.near_depth, before.view.near_depth);
  EXPECT_EQ(after.view.far_depth, before.view.far_depth);
  EXPECT_NEAR(after.receivers_outside, before.receivers_outside, 1e-12);
}

TEST(ViewFit, WhatIsAskedForIsKept) {
  Light light = plate_light();
  light.window = Window{-0.1, -0.2, 0.3, 0.4};
  light.near_depth = 0.25;
  light.far_depth = 100;
  const FittedView fitted = fit_view(plate_scene(), light, 1, 1);
  EXPECT_EQ(fitted.view.window, *light.window);
  EXPECT_EQ(fitted.view.near_depth, 0.25);
  EXPECT_EQ(fitted.view.far_depth, 100);
  EXPECT_FALSE(fitted.window_fitted || fitted.near_fitted || fitted.far_fitted);
  EXPECT_FALSE(fitted.nothing_casts);
  // The plate at depth 3.5 spans x -0.4 .. 0.8, y -0.5 .. 0.3, the window x -0.35 .. 1.05, y -0.7 .. 1.4.
  const double inside = 0.4 * 0.6 * 36 + 1.15 * 0.8;
  EXPECT_NEAR(fitted.receivers_outside, 1 - inside / 400.96, 1e-9);
}

std::string fault_of(const Light& light) {
  try {
    (void)fit_view(plate_scene(), light, 1, 1);
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::input);
    return error.what();
  }
  return "";
}

TEST(ViewFit, ImpossibleRequestsAreRefused) {
  Light light = plate_light();
  light.near_depth = 7;
  EXPECT_EQ(fault_of(light), "lamp.near: must be less than far (6.00001, the farthest receiver)");
  light.far_depth = 7;
  EXPECT_EQ(fault_of(light), "lamp.near: must be less than far (7)");
  light.near_depth = -1;
  EXPECT_EQ(fault_of(light), "lamp.near: must be a number > 0");
  light.near_depth.reset();
  light.far_depth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(light), "lamp.far: must be a number > 0");
  light.far_depth.reset();
  light.window = Window{1, 0, -1, 1};
  EXPECT_EQ(fault_of(light), "lamp.window: must be [x0,y0,x1,y1] with x0 < x1, y0 < y1");
}

TEST(ViewFit, ALightWithoutReceiversInItsWindowReachesNothing) {
  EXPECT_FALSE(fit_view(plate_scene(), plate_light(), 1, 1).nothing_receives);
  Scene scene = plate_scene();
  for (Geometry& geometry : scene.geometry) geometry.receives = false;
  EXPECT_TRUE(fit_view(scene, plate_light(), 1, 1).nothing_receives);
  EXPECT_TRUE(fit_view(Scene{}, plate_light(), 1, 1).nothing_receives);
  // The floor of 20 m is seen up to slope 10 / 6.
  Light aside = plate_light();
  aside.window = Window{1.6, -1, 1.7, 1};
  EXPECT_FALSE(fit_view(plate_scene(), aside, 1, 1).nothing_receives);
  aside.window = Window{1.7, -1, 1.8, 1};
  EXPECT_TRUE(fit_view(plate_scene(), aside, 1, 1).nothing_receives);
  Light upwards = plate_light();
  upwards.direction = {0, 1, 0};
  EXPECT_TRUE(fit_view(plate_scene(), upwards, 1, 1).nothing_receives);
}

TEST(ViewFit, WithoutReceiversCastersAreFitted) {
  Scene scene = plate_scene();
  for (Geometry& geometry : scene.geometry) geometry.receives = false;
  const FittedView fitted = fit_view(scene, plate_light(), 1, 1);
  EXPECT_NEAR(fitted.view.far_depth, 6, 6 * kPad);
  EXPECT_NEAR(fitted.view.near_depth, 3.5, 3.5 * kPad);
  EXPECT_EQ(fitted.receivers_outside, 0);
}

TEST(ViewFit, EmptySceneHasAView) {
  const FittedView fitted = fit_view(Scene{}, plate_light(), 1, 1);
  EXPECT_TRUE(fitted.nothing_casts);
  EXPECT_LT(0, fitted.view.near_depth);
  EXPECT_LT(fitted.view.near_depth, fitted.view.far_depth);
  EXPECT_LT(fitted.view.window[0], fitted.view.window[2]);
  EXPECT_LT(fitted.view.window[1], fitted.view.window[3]);
}

TEST(ViewFit, ReceiverSeenEdgeOnHasAWindow) {
  Scene scene;
  glm::dmat4 upright(1.0);
  upright[0] = {0, 1, 0, 0};
  upright[1] = {-1, 0, 0, 0};
  upright[3] = {0, 2, 0, 1};
  scene.geometry = {placed(plate_mesh(1, 1), upright)};
  const Window& w = fit_view(scene, lamp_above({0, 6, 0}, 0, 0), 1, 1).view.window;
  EXPECT_LT(w[0], 0);
  EXPECT_GT(w[2], 0);
  EXPECT_LT(w[2] - w[0], 1e-3);
}

TEST(ViewFit, FarSlabIsFittedToItsFaceTowardsTheLight) {
  Scene scene = plate_scene();
  scene.geometry[1] = placed(box_mesh({20, 3, 20}), {0, -1.5, 0});
  EXPECT_NEAR(fit_view(scene, plate_light(), 1, 1).view.far_depth, 6, 6 * kPad);
}

TEST(ViewFit, OnlyFacesTowardsTheLightCountAsOutside) {
  // A closed slab shows its top alone: within the window, nothing of it is outside.
  Scene scene;
  scene.geometry = {placed(box_mesh({2, 1, 2}), {0, 0, 0})};
  Light light = plate_light();
  light.window = Window{-0.5, -0.5, 0.5, 0.5};
  EXPECT_EQ(fit_view(scene, light, 1, 1).receivers_outside, 0);
  // Half of the top in the window.
  light.window = Window{0, -0.5, 0.5, 0.5};
  EXPECT_NEAR(fit_view(scene, light, 1, 1).receivers_outside, 0.5, 1e-12);
  // As an open mesh all of its six sides count: 4 of 16 are the top, 4 the bottom, 2 a side.
  Mesh open = box_mesh({2, 1, 2});
  open.closed = false;
  scene.geometry = {placed(open, {0, 0, 0})};
  light.window = Window{-5, -5, 5, 5};
  EXPECT_EQ(fit_view(scene, light, 1, 1).receivers_outside, 0);
  light.window = Window{0, -5, 5, 5};
  EXPECT_NEAR(fit_view(scene, light, 1, 1).receivers_outside, 0.5, 1e-12);
}

TEST(ViewFit, TrianglesThatAreNotFiniteAreIgnored) {
  Scene scene = plate_scene();
  const FittedView before = fit_view(scene, plate_light(), 1, 1);
  Mesh broken = plate_mesh(1, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  broken.positions[0] = {nan, 0, 0};
  broken.positions[3] = {0, -inf, 0};
  broken.triangles.emplace_back(0U, 1U, 99U);
  scene.geometry.push_back(placed(broken, {0, 4, 0}));
  const FittedView after = fit_view(scene, plate_light(), 1, 1);
  EXPECT_EQ(after.view.window, before.view.window);
  EXPECT_EQ(after.view.near_depth, before.view.near_depth);
}

/// A scene in which nothing is aligned.
std::pair<Scene, Light> skew_scene(const glm::dvec3& move, double scale) {
  Scene scene = plate_scene();
  scene.geometry.push_back(placed(box_mesh({0.3, 1.7, 0.4}), {-0.7, 0.9, 0.6}));
  for (Geometry& geometry : scene.geometry) {
    glm::dmat4& m = geometry.local_to_world;
    for (int column = 0; column < 3; ++column) m[column] *= scale;
    m[3] = glm::dvec4(glm::dvec3(m[3]) * scale + move, 1.0);
  }
  Light light = lamp_above(glm::dvec3(-1.1, 6.3, 0.7) * scale + move, 1.3 * scale, 0.9 * scale);
  light.direction = {0.3, -1, -0.2};
  return {scene, light};
}

TEST(ViewFit, FarFromTheOriginItIsTheSame) {
  const auto [scene, light] = skew_scene({0, 0, 0}, 1);
  const auto [moved_scene, moved_light] = skew_scene({1e6, -1e6, 1e6}, 1);
  const FittedView here = fit_view(scene, light, 1, 1), there = fit_view(moved_scene, moved_light, 1, 1);
  expect_window(there.view.window, here.view.window, 1e-9);
  EXPECT_NEAR(there.view.near_depth, here.view.near_depth, 1e-9 * here.view.near_depth);
  EXPECT_NEAR(there.view.far_depth, here.view.far_depth, 1e-9 * here.view.far_depth);
  EXPECT_NEAR(there.receivers_outside, here.receivers_outside, 1e-9);
}

TEST(ViewFit, WithNumbersThatCanBeMovedItIsExactlyTheSame) {
  // Multiples of 2^-7 keep all their digits at 2^30.
  const auto fit = [](const glm::dvec3& move) {
    Scene scene;
    scene.geometry = {placed(plate_mesh(1.25, 0.75), glm::dvec3(0.125, 2.5, -0.25) + move),
                      placed(plate_mesh(16, 16), move)};
    Light light = lamp_above(glm::dvec3(0.5, 6, 1) + move, 2, 1);
    light.direction = {0.3, -1, -0.2};
    return fit_view(scene, light, 1, 1);
  };
  const FittedView here = fit({0, 0, 0}), there = fit({0x1.0p30, -0x1.0p29, 0x1.0p30});
  EXPECT_EQ(there.view.window, here.view.window);
  EXPECT_EQ(there.view.near_depth, here.view.near_depth);
  EXPECT_EQ(there.view.far_depth, here.view.far_depth);
}

TEST(ViewFit, ScaledByPowersOfTwoItIsExactlyTheSame) {
  const auto [scene, light] = skew_scene({0, 0, 0}, 1);
  const FittedView plain = fit_view(scene, light, 1, 1);
  for (const double scale : {0x1.0p-20, 0x1.0p20}) {
    const auto [scaled_scene, scaled_light] = skew_scene({0, 0, 0}, scale);
    const FittedView scaled = fit_view(scaled_scene, scaled_light, 1, 1);
    EXPECT_EQ(scaled.view.window, plain.view.window);
    EXPECT_EQ(scaled.view.near_depth, plain.view.near_depth * scale);
    EXPECT_EQ(scaled.view.far_depth, plain.view.far_depth * scale);
    EXPECT_EQ(scaled.receivers_outside, plain.receivers_outside);
  }
}

}  // namespace
}  // namespace pdsm::test
