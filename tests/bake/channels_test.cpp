// SPDX-License-Identifier: Apache-2.0
// Coloured casters and lights: functions of red, green and blue, where they differ.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "events/transmittance_events.h"
#include "pdsm/bake/map_key.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/look_up.h"
#include "scene/scene_channels.h"
#include "scratch_folder.h"
#include "support/baked_functions.h"
#include "support/checkpoint_case.h"
#include "support/compare.h"
#include "support/exact_truth.h"
#include "support/merged_shards.h"
#include "support/translucent.h"

namespace pdsm::test {
namespace {

using pdsm::testing::ScratchFolder;

constexpr double kOccluder = 4, kFar = 8;
const glm::dvec3 kRuby(0.9, 0.25, 0);

void add_glass(Scene& scene, const Plate& plate, const glm::dvec3& transmission) {
  add(scene, plate, Roles::caster);
  scene.geometry.back().transmission = transmission;
}

/// A pane of ruby before an opaque plate, over a floor; the pane is in reach of a part of the map alone.
Scene window_scene() {
  Scene scene;
  add_glass(scene, Plate{-2, -2, -0.6, 2, 3}, kRuby);
  add(scene, Plate{0.5, -1, 1.5, 1, 5});
  add(scene, everywhere(kFar));
  return scene;
}

TEST(Channels, StainedGlassPerChannel) {
  Scene scene;
  add_glass(scene, everywhere(kOccluder), kRuby);
  add_glass(scene, everywhere(6), {0.5, 0.5, 1});
  const BakedFunctions baked(scene, square_light(), translucent_options());
  ASSERT_EQ(baked.map().channels, 3U);
  ASSERT_EQ(baked.map().images.size(), 3U);
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    EXPECT_EQ(baked.map().images[channel].channel, channel);
    const double first = 1 - kRuby[static_cast<int>(channel)];
    const double both = 1 - kRuby[static_cast<int>(channel)] * (channel == 2 ? 1 : 0.5);
    for (std::uint32_t n = 0; n < 48; n += 5) {
      EXPECT_EQ(baked.value(n, 47 - n, 3.9, channel), 0);
      EXPECT_NEAR(baked.value(n, 47 - n, 5.0, channel), first, translucent_tolerance()) << channel;
      EXPECT_NEAR(baked.value(n, 47 - n, 7.9, channel), both, translucent_tolerance()) << channel;
    }
  }
}

TEST(Channels, OnlyWhatIsColouredHasThree) {
  Scene grey;
  add_glass(grey, everywhere(kOccluder), glm::dvec3(0.25));
  const BakedFunctions through(grey, square_light(), translucent_options());
  EXPECT_EQ(through.map().channels, 1U);
  // The same as its opacity, to the byte.
  Scene translucent;
  add_glass(translucent, everywhere(kOccluder), glm::dvec3(0));
  translucent.geometry.back().opacity = 0.75;
  expect_same_bytes(through, BakedFunctions(translucent, square_light(), translucent_options()));
  // Out of the light's reach, glass costs nothing.
  Scene beside;
  add(beside, Plate{-1, -1, 1, 1, kOccluder});
  const BakedFunctions plain(beside, square_light(), translucent_options());
  add_glass(beside, Plate{30, 30, 31, 31, kOccluder}, kRuby);
  const BakedFunctions with_glass(beside, square_light(), translucent_options());
  EXPECT_EQ(with_glass.map().channels, 1U);
  expect_same_bytes(plain, with_glass);
  EXPECT_EQ(plain.report().key, with_glass.report().key);
}

TEST(Channels, ThreeArePutInPlaceOfOneByClearGlass) {
  Scene clear;
  add(clear, Plate{-1, -1, 1, 1, kOccluder});
  const BakedFunctions plain(clear, square_light(), translucent_options());
  add_glass(clear, everywhere(3), glm::dvec3(1));
  EXPECT_FALSE(casts_shadows(clear.geometry.back()));
  expect_same_bytes(plain, BakedFunctions(clear, square_light(), translucent_options()));
}

TEST(Channels, BlocksBehindNoGlassAreThoseOfRed) {
  const BakedFunctions baked(window_scene(), square_light(), translucent_options(192, 16));
  ASSERT_EQ(baked.map().channels, 3U);
  std::size_t same = 0;
  const auto& blocks = baked.baked().blocks;
  for (std::size_t n = 0; n < blocks[0].size(); ++n) same += blocks[0][n].bytes == blocks[1][n].bytes ? 1 : 0;
  // One column of three lies behind the plate alone, one is reached by both.
  EXPECT_GE(same, 3U);
  EXPECT_LT(same, 9U);
}

TEST(Channels, TwoHalvesOfTwoColours) {
  constexpr std::uint32_t kSamples = 256;
  constexpr double kEdge = 0.3;
  const std::array<glm::vec3, 2> halves{glm::vec3(1, 1, 0), glm::vec3(0, 3, 2)};
  Light light = rect_light(2, 1);
  light.emission = std::make_shared<const EmissionImage>(EmissionImage{2, 1, {1, 2}, {halves[0], halves[1]}});
  set_view(light, 0.5, 0.25, 2, kFar);
  Scene scene;
  add(scene, Plate{kEdge, -kWide, kWide, kWide, 3});
  add(scene, everywhere(kFar));
  BakeOptions options = small_options(33, 5, kSamples);
  options.map_width = 4 * 33;
  options.map_height = 4 * 5;
  const BakedFunctions baked(scene, light, options);
  ASSERT_EQ(baked.map().channels, 3U);
  const double moved = texel_reach(options.walk) * baked.map_pitch_x() * 3;
  const double delta = baked.report().depth_tolerance;
  const double slack = sampling_tolerance(edge_strata(kSamples), kSamples) + baked.report().epsilon;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    const auto c = static_cast<int>(channel);
    const auto left = static_cast<double>(halves[0][c]), right = static_cast<double>(halves[1][c]);
    for (std::uint32_t i = 0; i < 33; ++i) {
      for (const double z : {4.0, 5.0, 6.5, 7.9}) {
        double low = 1, high = 0;
        for (const double depth : {z - delta, z + delta}) {
          const auto at = [&](double edge) {
            return two_halves(back_project(edge, 3, baked.slope_x(i), depth), left, right);
          };
          low = std::min(low, at(kEdge + moved));
          high = std::max(high, at(kEdge - moved));
        }
        EXPECT_GE(baked.value(i, 2, z, channel), low - slack) << channel << " " << i << " " << z;
        EXPECT_LE(baked.value(i, 2, z, channel), high + slack) << channel << " " << i << " " << z;
      }
    }
  }
}

TEST(Channels, APictureOfOneHueNeedsNoColour) {
  Light light = rect_light(2, 1);
  const auto picture = [&](const glm::vec3& left, const glm::vec3& right) {
    light.emission = std::make_shared<const EmissionImage>(EmissionImage{2, 1, {1, 3}, {left, right}});
    return is_coloured(light);
  };
  EXPECT_FALSE(picture({2, 1, 0.5F}, {6, 3, 1.5F}));
  EXPECT_FALSE(picture({0, 1, 0}, {0, 3, 0}));
  EXPECT_TRUE(picture({2, 1, 0.5F}, {6, 3, 1.45F}));
  // A hundred thousandth elsewhere is less than any file tells.
  EXPECT_FALSE(picture({2, 1, 0.5F}, {6, 3, 1.49999F}));
}

TEST(Channels, MasksOfGlassTakeWhatTheyDoNotLetThrough) {
  CutoutMask mask{2, 1, {255, 100}, {MaskWrap::clamp, MaskWrap::clamp}, 0, true};
  mask.transmission = {{255, 128, 0}, {255, 128, 0}};
  Geometry geometry;
  auto mesh = std::make_shared<Mesh>(plate_mesh(everywhere(1)));
  mesh->mask = std::make_shared<const CutoutMask>(mask);
  mesh->mask_places.resize(mesh->positions.size());
  geometry.mesh = mesh;
  geometry.transmission = {1, 0.5, 0.5};
  EXPECT_TRUE(is_coloured_caster(geometry));
  const auto alpha = [&](std::uint32_t channel) {
    const Geometry of_channel = channel_geometry(geometry, channel);
    EXPECT_EQ(of_channel.transmission, glm::dvec3(0));
    EXPECT_EQ(of_channel.opacity, 1);
    return of_channel.mesh->mask->alpha;
  };
  // 1 - 0.5 x 128 / 255 = 0.749 of 255 and of 100.
  EXPECT_EQ(alpha(0), (std::vector<std::uint8_t>{0, 0}));
  EXPECT_EQ(alpha(1), (std::vector<std::uint8_t>{191, 75}));
  EXPECT_EQ(alpha(2), (std::vector<std::uint8_t>{255, 100}));
}

TEST(Channels, ThreadsTilesAndShardsGiveTheSameBytes) {
  BakeOptions options = translucent_options(150, 16);
  options.mip_levels = 2;
  const BakedMap whole = bake(window_scene(), square_light(), options);
  EXPECT_GT(whole.report.events, 1000U);
  options.tile = 64;
  options.threads = 3;
  expect_same_bake(bake(window_scene(), square_light(), options), whole);
  const BakedMap merged = bake_in_shards(window_scene(), square_light(), options, 2);
  expect_same_bake(merged, whole);
  EXPECT_EQ(merged.map.channels, 3U);
  EXPECT_EQ(merged.map.views, whole.map.views);
}

TEST(Channels, GoOnFromACheckpoint) {
  const ScratchFolder folder;
  const auto file = folder.path() / "a.partial";
  BakeOptions options = translucent_options(150, 16);
  const BakedMap whole = bake(window_scene(), square_light(), options);
  options.tile = 64;
  {
    Checkpoint checkpoint({file, 0, {}});
    BakeCallbacks callbacks;
    double done = 0;
    callbacks.progress = [&](const BakeProgress& progress) { done = progress.done; };
    callbacks.cancelled = [&] { return done >= 0.6; };
    EXPECT_THROW((void)bake(window_scene(), square_light(), options, callbacks, &checkpoint), Error);
  }
  Checkpoint checkpoint({file, 0, {}});
  const BakedMap resumed = bake(window_scene(), square_light(), options, {}, &checkpoint);
  expect_same_bake(resumed, whole);
  EXPECT_LT(resumed.report.tiles, 27U);
}

TEST(Channels, AllViewsOfASphereHaveThem) {
  Light light = rect_light(1, 1);
  light.shape = SphereLight{0.2};
  Scene scene;
  add_glass(scene, Plate{-1, -1, 1, 1, 2}, kRuby);
  add_glass(scene, Plate{-1, -1, 1, 1, -2}, {0, 1, 0.5});
  add(scene, Plate{-3, -3, 3, 3, 4});
  add(scene, Plate{-3, -3, 3, 3, -4});
  BakeOptions options = translucent_options(64, 16);
  options.mip_levels = 1;
  const BakedFunctions baked(scene, light, options);
  ASSERT_EQ(baked.map().views.size(), 6U);
  ASSERT_EQ(baked.map().images.size(), 36U);
  for (std::uint32_t n = 0; n < 36; ++n) {
    EXPECT_EQ(baked.map().images[n].view, n / 6);
    EXPECT_EQ(baked.map().images[n].channel, n / 2 % 3);
    EXPECT_EQ(baked.map().images[n].level, n % 2);
  }
  // Behind the middle of either pane all of the light comes through it.
  const PenumbraLookUp look_up(baked.map());
  const auto front = look_up.at({0, 0, 3}, Filter::bilinear).rgb,
             back = look_up.at({0, 0, -3}, Filter::bilinear).rgb;
  for (int channel = 0; channel < 3; ++channel) {
    const auto n = static_cast<std::size_t>(channel);
    EXPECT_NEAR(static_cast<double>(front[n]), 1 - kRuby[channel], translucent_tolerance(16)) << channel;
    EXPECT_NEAR(static_cast<double>(back[n]), 1 - glm::dvec3(0, 1, 0.5)[channel], translucent_tolerance(16))
        << channel;
  }
}

TEST(Channels, KeysTellTransmissionApart) {
  const BakeOptions options = translucent_options();
  const auto key_of = [&](const glm::dvec3& transmission) {
    Scene scene = window_scene();
    scene.geometry.front().transmission = transmission;
    return map_key(scene, square_light(), options).key;
  };
  EXPECT_EQ(key_of(kRuby), bake(window_scene(), square_light(), options).report.key);
  EXPECT_NE(key_of(kRuby), key_of({0.9, 0.25, 0.1}));
  EXPECT_NE(key_of(glm::dvec3(0.5)), key_of({0.5, 0.5, 0.4}));
}

TEST(Channels, RefuseWhatIsNoShare) {
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    Scene scene;
    add_glass(scene, everywhere(kOccluder), {0.5, share, 0.5});
    EXPECT_THROW((void)bake(scene, square_light(), translucent_options()), Error) << share;
  }
}

}  // namespace
}  // namespace pdsm::test
