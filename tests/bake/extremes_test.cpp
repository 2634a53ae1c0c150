// SPDX-License-Identifier: Apache-2.0
// Extremes that must come out exactly (numerics.md section 5).
#include <gtest/gtest.h>

#include <xmmintrin.h>

#include <cmath>
#include <limits>

#include "pdsm/runtime/look_up.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/exact_truth.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

constexpr double kFar = 8;

Light key_light() {
  Light light = rect_light(1, 1);
  set_view(light, 0.5, 0.4, 2, kFar);
  return light;
}

Scene plate_over_floor() {
  Scene scene;
  add(scene, Plate{-1.1, -0.9, 1.2, 1.3, 4});
  add(scene, Plate{-20, -20, 20, 20, kFar});
  return scene;
}

TEST(Extremes, EmptySceneIsLitAndTracesNothing) {
  const BakedFunctions baked({}, rect_light(1, 1), small_options(70, 9, 16));
  EXPECT_EQ(baked.vertex_count(), 0u);
  EXPECT_EQ(baked.report().rays, 0u);
  EXPECT_EQ(baked.report().empty_texels, 630u);
  const PenumbraLookUp look_up(baked.map());
  EXPECT_EQ(look_up.at({0, 0, 5}, Filter::bilinear).attenuation, 0);
}

TEST(Extremes, SceneWithoutCastersIsLitAndTracesNothing) {
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, 3}, Roles::receiver);
  add(scene, Plate{-9, -9, 9, 9, 6}, Roles::receiver);
  const BakedFunctions baked(scene, rect_light(1, 1), small_options(40, 30, 16));
  EXPECT_EQ(baked.vertex_count(), 0u);
  EXPECT_EQ(baked.report().rays, 0u);
}

TEST(Extremes, AFloorAloneIsLit) {
  Scene scene;
  add(scene, Plate{-9, -9, 9, 9, 6});
  for (const Receivers receivers : {Receivers::volume, Receivers::all}) {
    BakeOptions options = small_options(40, 30, 16);
    options.receivers = receivers;
    const BakedFunctions baked(scene, rect_light(1, 1), options);
    for (std::uint32_t n = 0; n < 30; ++n) EXPECT_EQ(baked.value(n, n, 6), 0);
  }
}

TEST(Extremes, CastersWithoutReceiversStillCast) {
  Scene scene;
  add(scene, Plate{-9, -9, 9, 9, 4}, Roles::caster);
  const BakedFunctions baked(scene, key_light(), small_options(8, 8, 16));
  EXPECT_EQ(baked.value(4, 4, 3.9), 0);
  EXPECT_EQ(baked.value(4, 4, 5), 1);
  EXPECT_EQ(baked.value(4, 4, 100), 1);
}

/// Under a plate that hides the whole light from everywhere, V is 1 to the bit: counts are whole.
TEST(Extremes, UmbraIsExactlyOne) {
  Scene scene;
  add(scene, Plate{-50, -50, 50, 50, 4});
  add(scene, Plate{-90, -90, 90, 90, kFar});
  for (const std::uint32_t samples : {1u, 3u, 255u, 256u, 1000u}) {
    for (const double epsilon : {0.0, 0.003, 0.02, 0.3}) {
      BakeOptions options = small_options(6, 5, samples);
      options.bias = 0.01;
      options.epsilon = epsilon;
      const BakedFunctions baked(scene, key_light(), options);
      const PenumbraLookUp look_up(baked.map());
      for (const double z : {4.2, 5.0, 7.999}) {
        EXPECT_EQ(look_up.at({0.3, -0.2, z}, Filter::bilinear).attenuation, 1.0F)
            << samples << ", epsilon " << epsilon;
        EXPECT_EQ(baked.value(0, 4, z), 1);
      }
    }
  }
}

/// An occluder between the light and a near that was asked for: shadow from the first depth on.
TEST(Extremes, ShadowAlreadyAtNear) {
  Scene scene;
  add(scene, Plate{-50, -50, 50, 50, 1});
  add(scene, Plate{-90, -90, 90, 90, kFar});
  Light light = key_light();
  light.near_depth = 3;
  for (const double epsilon : {0.0, 0.02}) {
    BakeOptions options = small_options(6, 5, 16);
    options.epsilon = epsilon;
    const BakedFunctions baked(scene, light, options);
    EXPECT_EQ(baked.value(2, 2, 3), 0);
    EXPECT_EQ(
        baked.value(2, 2,
                    3 + baked.report().depth_tolerance + 2 * depth_step(baked.view(), baked.map().coding)),
        1);
    EXPECT_EQ(baked.value(2, 2, 7), 1);
  }
}

/// Two small plates on the axis: V rises to 1, falls as the first one's shadow shrinks, and rises again.
TEST(Extremes, AFunctionRisesFallsAndRises) {
  const Plate first{-0.2, -0.2, 0.2, 0.2, 2.5}, second{-0.6, -0.6, 0.6, 0.6, 6};
  Scene scene;
  add(scene, first);
  add(scene, second);
  add(scene, Plate{-90, -90, 90, 90, kFar});
  Light light = key_light();
  light.window = {-0.05, -0.05, 0.05, 0.05};
  BakeOptions options = small_options(5, 5, 400);
  options.points = PointSet::jittered;
  const BakedFunctions baked(scene, light, options);
  // On the axis an edge appears displaced by half a texel; the plate is a convex shape to the light.
  const auto bounds = [&](double z, double sign) {
    const double moved = sign * 0.5 * baked.map_pitch_x() * 2.5;
    const Plate plate{-0.2 - moved, -0.2 - moved, 0.2 + moved, 0.2 + moved, 2.5};
    return rect_plate(1, 1, plate, 0, 0, z);
  };
  const double sampling = sampling_tolerance(outline_strata(400), 400);
  EXPECT_EQ(baked.value(2, 2, 2.5), 0);
  EXPECT_NEAR(baked.value(2, 2, 3), 1, 0.02);
  for (const double z : {4.5, 5.0, 5.9}) {
    EXPECT_GE(baked.value(2, 2, z), bounds(z, -1) - sampling - 0.02) << z;
    EXPECT_LE(baked.value(2, 2, z), bounds(z, 1) + sampling + 0.02) << z;
  }
  EXPECT_LT(bounds(5.9, 1) + sampling, 0.9) << "V must fall far enough to tell";
  EXPECT_NEAR(baked.value(2, 2, 6.3), 1, 0.02);
}

TEST(Extremes, MapsOfAnySize) {
  for (const auto& [width, height] : {std::pair(1u, 1u), std::pair(1u, 90u), std::pair(90u, 1u),
                                      std::pair(7u, 13u), std::pair(64u, 65u), std::pair(130u, 70u)}) {
    BakeOptions options = small_options(width, height, 9);
    options.bias = 0.01;
    options.epsilon = 0;
    // Even a map of one texel, shifted by half of it, stays within the plate.
    Light light = key_light();
    light.window = {-0.1, -0.1, 0.1, 0.1};
    const BakedFunctions baked(plate_over_floor(), light, options);
    const auto& image = baked.map().images[0];
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.blocks.size(), std::size_t{image.blocks_across()} * image.blocks_up());
    EXPECT_EQ(baked.value(width / 2, height / 2, 4.3), 1) << width << " x " << height;
    EXPECT_EQ(baked.value(width / 2, height / 2, 4), 0) << width << " x " << height;
  }
}

/// N = 1 is a point light at the centre: 0 or 1. N = 65536 counts beyond 16 bits.
TEST(Extremes, OneSampleAndSixtyFiveThousand) {
  BakeOptions one = small_options(16, 16, 1);
  one.epsilon = 0;
  one.bias = 0.01;
  const BakedFunctions single(plate_over_floor(), key_light(), one);
  for (std::uint32_t n = 0; n < 16; ++n) {
    const double value = single.value(n, n, 7);
    EXPECT_TRUE(value == 0 || value == 1);
    const double x = 4 * single.slope_x(n), y = 4 * single.slope_y(n), reach = 0.5 * 4 * single.map_pitch_x();
    const bool inside = x > -1.1 + reach && x < 1.2 - reach && y > -0.9 + reach && y < 1.3 - reach;
    const bool outside = x < -1.1 - reach || x > 1.2 + reach || y < -0.9 - reach || y > 1.3 + reach;
    EXPECT_TRUE(inside ? value == 1 : !outside || value == 0) << n;
  }
  for (const double epsilon : {0.0, 0.02}) {
    BakeOptions many = small_options(2, 2, 65536);
    many.epsilon = epsilon;
    many.bias = 1e-3;
    Light light = key_light();
    light.window = {-0.02, -0.02, 0.02, 0.02};
    const BakedFunctions baked(plate_over_floor(), light, many);
    EXPECT_EQ(baked.map().samples.size(), 65536u);
    EXPECT_EQ(baked.map().coding.value_max, epsilon == 0 ? 65536u : 255u);
    EXPECT_EQ(baked.value(0, 0, 4.01), 1) << epsilon;
  }
}

TEST(Extremes, PointAndLineLights) {
  for (const auto& [width, height] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
    Light light = rect_light(width, height);
    set_view(light, 0.5, 0.4, 2, kFar);
    BakeOptions options = small_options(32, 24, 32);
    options.epsilon = 0;
    options.bias = 0.01;
    const BakedFunctions baked(plate_over_floor(), light, options);
    EXPECT_EQ(baked.value(16, 12, 4.3), 1);
    if (width != 0 || height != 0) continue;
    // All samples of a point see the same but for the jitter of their maps: a texel at the edge at most.
    std::size_t partial = 0;
    for (std::uint32_t j = 0; j < 24; ++j) {
      for (std::uint32_t i = 0; i < 32; ++i) {
        const double value = baked.value(i, j, 7);
        partial += value > 0 && value < 1 ? 1 : 0;
      }
    }
    EXPECT_LE(partial, 2u * (32 + 24));
  }
}

/// A light far larger than the scene: V tends to the plate's share of the light, q_x q_y / L^2.
TEST(Extremes, ALightFarLargerThanTheScene) {
  Light light = rect_light(12, 12);
  set_view(light, 0.02, 0.02, 2, kFar);
  BakeOptions options = small_options(3, 3, 1024);
  options.points = PointSet::jittered;
  const BakedFunctions baked(plate_over_floor(), light, options);
  const double truth = rect_plate(12, 12, {-1.1, -0.9, 1.2, 1.3, 4}, 0, 0, 7.9);
  const double moved = 0.5 * baked.map_pitch_x() * 4;
  const double high =
      rect_plate(12, 12, {-1.1 - moved, -0.9 - moved, 1.2 + moved, 1.3 + moved, 4}, 0, 0, 7.9);
  EXPECT_NEAR(baked.value(1, 1, 7.9), truth,
              high - truth + sampling_tolerance(outline_strata(1024), 1024) + 0.02);
}

TEST(Extremes, TrianglesThatAreNotFiniteAreDroppedAndCounted) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  const BakedFunctions clean(plate_over_floor(), key_light(), small_options(32, 24, 16));
  Scene scene = plate_over_floor();
  Mesh dirty = *scene.geometry[0].mesh;
  const auto first = static_cast<std::uint32_t>(dirty.positions.size());
  dirty.positions.insert(dirty.positions.end(), {{kNan, 0, 3}, {0, kInf, 3}, {0, 0, -kInf}});
  dirty.triangles.insert(
      dirty.triangles.begin(),
      {{0, 1, first}, {first + 1, 1, 2}, {first, first + 1, first + 2}, {0, 1, first + 3}});
  scene.geometry[0].mesh = std::make_shared<const Mesh>(dirty);
  const BakedFunctions baked(scene, key_light(), small_options(32, 24, 16));
  expect_same_bytes(clean, baked);
  ASSERT_EQ(baked.report().warnings.size(), 1u);
  EXPECT_NE(baked.report().warnings[0].find("4 triangles"), std::string::npos) << baked.report().warnings[0];
  EXPECT_TRUE(clean.report().warnings.empty());
}

TEST(Extremes, DegenerateTrianglesAndDuplicatesChangeNothing) {
  const BakedFunctions clean(plate_over_floor(), key_light(), small_options(32, 24, 16));
  Scene scene = plate_over_floor();
  Mesh more = *scene.geometry[0].mesh;
  // A point, a line, and the plate once more from behind.
  more.triangles.insert(more.triangles.end(), {{0, 0, 0}, {0, 1, 1}, {0, 2, 1}, {0, 3, 2}});
  scene.geometry[0].mesh = std::make_shared<const Mesh>(more);
  expect_same_bytes(clean, {scene, key_light(), small_options(32, 24, 16)});
}

/// Geometry in the emitter's plane, or behind it, never blocks.
TEST(Extremes, GeometryInOrBehindTheEmitterNeverBlocks) {
  const BakedFunctions clean(plate_over_floor(), key_light(), small_options(32, 24, 16));
  Scene scene = plate_over_floor();
  add(scene, Plate{-5, -5, 5, 5, 0});
  add(scene, Plate{-5, -5, 5, 5, -1});
  add(scene, Plate{-5, -5, 5, 5, 1e-4});
  expect_same_bytes(clean, {scene, key_light(), small_options(32, 24, 16)});
}

/// A light inside a solid: the solid hides all of it.
TEST(Extremes, ALightInsideAnOccluderIsHiddenEverywhere) {
  Scene scene;
  add(scene, box_mesh({-2, -2, -1}, {2, 2, 1.5}));
  add(scene, Plate{-20, -20, 20, 20, kFar});
  Light light = rect_light(1, 1);
  light.window = {-0.5, -0.4, 0.5, 0.4};
  BakeOptions options = small_options(24, 24, 64);
  options.epsilon = 0;
  const BakedFunctions baked(scene, light, options);
  for (std::uint32_t n = 0; n < 24; ++n) {
    EXPECT_EQ(baked.value(n, n, 2), 1);
    EXPECT_EQ(baked.value(n, 23 - n, kFar - 0.1), 1);
  }
}

/// Wires narrower than a texel are not lost, nor do they grow: the shadow of a strip w wide at depth h is w z
/// / h wide at depth z, in the mean over the light, whatever the light's size.
TEST(Extremes, WiresBelowATexelKeepTheirMeanCoverage) {
  constexpr std::uint32_t kSamples = 4096, kTexels = 64;
  constexpr double kDepth = 4, kReceiver = 6;
  Light light = rect_light(0.3, 0.3);
  set_view(light, 0.5, 0.05, 2, kFar);
  BakeOptions options = small_options(kTexels, 6, kSamples);
  options.epsilon = 0;
  const double texel = 1.0 / kTexels;  // in slope
  for (const double share : {0.25, 0.5, 0.9}) {
    const double width = share * texel * kDepth;
    Scene scene;
    add(scene, Plate{0.13, -kWide, 0.13 + width, kWide, kDepth});
    add(scene, Plate{-90, -90, 90, 90, kFar});
    const BakedFunctions baked(scene, light, options);
    double covered = 0;  // in texels of the receiver's depth
    for (std::uint32_t i = 0; i < kTexels; ++i) covered += baked.value(i, 3, kReceiver);
    // Each sample's jittered row of texels meets the wire in one texel or none: Hoeffding at 1e-6 over
    // samples.
    const double tolerance = std::sqrt(std::log(2e6) / (2.0 * kSamples));
    EXPECT_NEAR(covered, share, tolerance) << share;
  }
}

/// Denormals: the caller's rounding mode for them changes nothing, and comes back as it was.
TEST(Extremes, TheCallersDenormalModeChangesNothing) {
  constexpr unsigned kFlush = 0x8040;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before & ~kFlush);
  const BakedFunctions kept(plate_over_floor(), key_light(), small_options(48, 48, 16));
  EXPECT_EQ(_mm_getcsr() & kFlush, 0u);
  _mm_setcsr(before | kFlush);
  const BakedFunctions flushed(plate_over_floor(), key_light(), small_options(48, 48, 16));
  EXPECT_EQ(_mm_getcsr() & kFlush, kFlush);
  _mm_setcsr(before);
  expect_same_bytes(kept, flushed);
}

/// An occluder that nearly touches the light hides what it covers, at any depth.
TEST(Extremes, AnOccluderAtTheLightHidesWhatItCovers) {
  Scene scene;
  add(scene, Plate{0, -5, 5, 5, 0.01});
  add(scene, Plate{-90, -90, 90, 90, kFar});
  Light light = rect_light(1, 1);
  set_view(light, 0.05, 0.05, 1, kFar);
  BakeOptions options = small_options(3, 3, 256);
  options.points = PointSet::jittered;
  const BakedFunctions baked(scene, light, options);
  // The edge at x = 0 is displaced by 0.01 pitch / 2 at most; one line of 16 strata could be cut.
  EXPECT_NEAR(baked.value(1, 1, 5), 0.5,
              sampling_tolerance(edge_strata(256), 256) + 0.02 + 0.01 * baked.map_pitch_x());
}

}  // namespace
}  // namespace pdsm::test
