// SPDX-License-Identifier: Apache-2.0
// Casters that let a part of the light through.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "events/transmittance_events.h"
#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/cutouts.h"
#include "support/translucent.h"
#include "trace/layer_map.h"

namespace pdsm::test {
namespace {

void add_sheet(Scene& scene, const Plate& plate, double opacity) {
  add(scene, plate, Roles::caster);
  scene.geometry.back().opacity = opacity;
}

/// Calls check(i, j) for some texels.
template <typename Check>
void for_some_texels(const BakedFunctions& baked, Check&& check) {
  for (std::uint32_t j = 0; j < baked.view().height; j += 5)
    for (std::uint32_t i = 0; i < baked.view().width; i += 5) check(i, j);
}

TEST(Layers, AThousandOfOnePercentMultiply) {
  std::vector<MetSurface> surfaces;
  for (int n = 0; n < 1000; ++n) surfaces.push_back({1.0F + 0.001F * static_cast<float>(n), 0.01});
  std::vector<Layer> layers;
  constexpr std::uint32_t kUnit = 1U << 31;
  append_layers(surfaces, std::numeric_limits<float>::infinity(), kUnit, layers);
  ASSERT_EQ(layers.size(), 1000U);
  EXPECT_NEAR(layers.back().behind / static_cast<double>(kUnit), 4.31713e-5, 1e-5 * 4.31713e-5);
  layers.clear();
  append_layers(surfaces, std::numeric_limits<float>::infinity(), kMostTransmittanceUnit, layers);
  EXPECT_NEAR(layers.back().behind / static_cast<double>(kMostTransmittanceUnit), std::pow(0.99, 1000),
              0.5 / kMostTransmittanceUnit);
}

TEST(Layers, EndAtTheOpaqueCasterAndJoinAtOneDepth) {
  std::vector<Layer> layers;
  append_layers(std::vector<MetSurface>{{1, 0.5}, {2, 0.5}, {2, 0.5}, {3, 0}, {4, 0.5}}, 4, 1000, layers);
  EXPECT_EQ(layers, (std::vector<Layer>{{1, 500}, {2, 125}}));
}

TEST(TransmittanceEvents, SumInAnyOrder) {
  EventBudget budget(1 << 20);
  EventLog log(&budget);
  const auto put = [&](float depth, std::uint32_t change, bool unblocks) {
    *log.reserve(1) = pack_change(4095, depth, change, 1000, unblocks);
    log.commit(1);
  };
  put(3, 1000, true);
  put(2, 400, false);
  put(1, 600, false);
  put(2, 1000, false);
  *log.reserve(1) = pack_event(4095, 5, true);  // of an opaque walk
  log.commit(1);
  BlockChanges changes;
  const EventLog* const logs[] = {&log};
  gather_changes(logs, 4096, changes);
  EXPECT_EQ(changes.first[4095], 0U);
  StepFunction function;
  sum_changes(changes.keys, 1000, 0, function);
  EXPECT_EQ(function.depth, (std::vector<float>{1, 2, 3, 5}));
  EXPECT_EQ(function.count, (std::vector<std::uint32_t>{600, 2000, 1000, 0}));
  sum_changes(changes.keys, 1000, 1, function);
  EXPECT_EQ(function.count, (std::vector<std::uint32_t>{150, 500, 250, 0}));
}

TEST(Translucency, OnePlateTakesItsOpacityAtAllDepths) {
  Scene scene;
  add_sheet(scene, everywhere(4), 0.3);
  const BakedFunctions baked(scene, square_light(), translucent_options());
  for_some_texels(baked, [&](std::uint32_t i, std::uint32_t j) {
    for (const double z : {2.5, 3.9}) EXPECT_EQ(baked.value(i, j, z), 0);
    for (const double z : {4.2, 6.0, 7.9})
      ASSERT_NEAR(baked.value(i, j, z), 0.3, translucent_tolerance()) << i << j;
  });
}

TEST(Translucency, PlatesMultiplyAndOpaqueIsUmbra) {
  for (const double opaque : {3.0, 5.0, 7.0}) {
    Scene scene;
    add_sheet(scene, everywhere(4), 0.3);
    add_sheet(scene, everywhere(6), 0.5);
    add(scene, everywhere(opaque), Roles::caster);
    const BakedFunctions baked(scene, square_light(), translucent_options());
    for_some_texels(baked, [&](std::uint32_t i, std::uint32_t j) {
      for (const double z : {2.5, 3.5, 4.5, 5.5, 6.5, 7.5}) {
        const double passed = (z > 4 ? 0.7 : 1) * (z > 6 ? 0.5 : 1);
        if (z > opaque)
          ASSERT_EQ(baked.value(i, j, z), 1) << z;
        else
          ASSERT_NEAR(baked.value(i, j, z), 1 - passed, translucent_tolerance()) << z;
      }
    });
  }
}

/// The functions of a translucent plate are those of the opaque one, times its opacity: both walks see the
/// same events.
void expect_opaque_times(double opacity, const Scene& sheet, const Plate& plate) {
  Scene opaque;
  add(opaque, plate, Roles::caster);
  const BakedFunctions a(opaque, square_light(), translucent_options()),
      b(sheet, square_light(), translucent_options());
  for_some_texels(a, [&](std::uint32_t i, std::uint32_t j) {
    // Within delta of an event, either of its sides may be what is kept.
    for (double z = 2.5; z < 8; z += 0.37) {
      const double low = a.value(i, j, z - 3e-3), high = a.value(i, j, z + 3e-3);
      EXPECT_GE(b.value(i, j, z),
                opacity * (std::min(low, high) - kTranslucentEpsilon) - translucent_tolerance())
          << z;
      EXPECT_LE(b.value(i, j, z),
                opacity * (std::max(low, high) + kTranslucentEpsilon) + translucent_tolerance())
          << z;
    }
  });
}

constexpr Plate kPlate{-0.6, -0.4, 0.5, 0.7, 4};

TEST(Translucency, APlatesPenumbraIsTheOpaqueOnesTimesOpacity) {
  Scene sheet;
  add_sheet(sheet, kPlate, 0.6);
  expect_opaque_times(0.6, sheet, kPlate);
}

TEST(Translucency, AMaskOfFullAlphaIsOpaque) {
  CutoutMask mask = make_mask(1, 1, 0, [](std::uint32_t, std::uint32_t) { return true; });
  mask.blends = true;
  Scene sheet;
  add(sheet, cut_plate(kPlate, mask), Roles::caster);
  expect_opaque_times(1, sheet, kPlate);
}

TEST(Translucency, OpacityZeroIsNotThere) {
  Scene none, zero;
  add(none, everywhere(7));
  add(none, Plate{-0.2, -0.3, 0.4, 0.1, 5}, Roles::caster);
  zero = none;
  add_sheet(zero, kPlate, 0);
  for (const bool near_is_given : {false, true}) {
    Light light = rect_light(1, 1);
    light.window = {-0.5, -0.5, 0.5, 0.5};
    if (near_is_given) light.near_depth = 2;
    expect_same_bytes({none, light, translucent_options()}, {zero, light, translucent_options()});
  }
}

CutoutMask halves(std::uint8_t left, std::uint8_t right) {
  CutoutMask mask = make_mask(16, 1, 0, [](std::uint32_t, std::uint32_t) { return false; });
  for (std::size_t n = 0; n < 16; ++n) mask.alpha[n] = n < 8 ? left : right;
  mask.wrap = {MaskWrap::clamp, MaskWrap::clamp};
  mask.blends = true;
  return mask;
}

TEST(Translucency, TexturedAlphaIsTheOpacity) {
  Scene scene;
  add(scene, cut_plate({-32, -32, 32, 32, 4}, halves(51, 204)), Roles::caster);
  scene.geometry.back().opacity = 0.5;
  // Texels of 4 m, alpha linear between the middle two: the light is seen beyond 2 m by the outermost rays.
  Light wide = rect_light(1, 1);
  set_view(wide, 2, 2, 2, 8);
  const BakedFunctions far(scene, wide, translucent_options());
  const std::uint32_t last = far.view().width - 1;
  for (const double z : {4.5, 6.0, 7.9}) {
    EXPECT_NEAR(far.value(0, 20, z), 0.5 * 0.2, translucent_tolerance()) << z;
    EXPECT_NEAR(far.value(last, 20, z), 0.5 * 0.8, translucent_tolerance()) << z;
  }
}

TEST(Translucency, AMinifiedTextureHasItsMean) {
  // Stripes of alpha 0 and 1, many to a map texel: a hashed point each, of variance 1/4.
  CutoutMask mask = make_mask(2, 1, 0, [](std::uint32_t i, std::uint32_t) { return i == 0; });
  mask.blends = true;
  Scene scene;
  add(scene, cut_plate({-32, -32, 32, 32, 4}, mask, {0, 0, 4096, 1}), Roles::caster);
  scene.geometry.back().opacity = 0.6;
  const BakedFunctions baked(scene, square_light(), translucent_options(48, 64));
  double sum = 0;
  int count = 0;
  for (std::uint32_t j = 0; j < 48; j += 2) {
    for (std::uint32_t i = 0; i < 48; i += 2, ++count) sum += baked.value(i, j, 4.5);
  }
  // Hoeffding over count x 64 draws within 0 .. 0.6, at 1e-6; rays of neighbours share texels, so that no
  // more than one map texel of each ray and sample is its own.
  const double draws = count * 64.0;
  EXPECT_NEAR(sum / count, 0.3, 0.6 * std::sqrt(std::log(2 / 1e-6) / (2 * draws)) + translucent_tolerance());
}

Scene mixed_scene() {
  Scene scene = foliage_scene();
  for (std::size_t n = 0; n + 2 < scene.geometry.size(); n += 3) scene.geometry[n].opacity = 0.25;
  add_sheet(scene, {-1, -1, 1, 1, 5}, 0.4);
  return scene;
}

TEST(Translucency, ThreadsAndTilesDecideNothing) {
  BakeOptions options = translucent_options(150, 16);
  options.mip_levels = 3;
  options.receivers = Receivers::volume;
  const BakedFunctions one(mixed_scene(), square_light(), options);
  EXPECT_GT(greatest_value(one), 0.5);
  for (const std::uint32_t threads : {2U, 4U}) {
    options.threads = threads;
    options.tile = threads == 2 ? 64 : 128;
    expect_same_bytes(one, {mixed_scene(), square_light(), options});
  }
}

TEST(Translucency, WhatCannotBeIsRefused) {
  for (const double opacity : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    Scene scene;
    add_sheet(scene, everywhere(4), opacity);
    EXPECT_THROW(static_cast<void>(bake(scene, square_light(), translucent_options())), Error) << opacity;
  }
  Scene scene;
  add_sheet(scene, everywhere(4), 0.5);
  BakeOptions lossless = translucent_options();
  lossless.epsilon = 0;
  EXPECT_THROW(static_cast<void>(bake(scene, square_light(), lossless)), Error);
}

}  // namespace
}  // namespace pdsm::test
