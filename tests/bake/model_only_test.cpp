// SPDX-License-Identifier: Apache-2.0
// Model only what a scene requires: what it lacks costs no byte, no ray, no pass, and the report says so.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

Light key_light() {
  Light light = rect_light(1, 1);
  set_view(light, 0.5, 0.4, 2, 8);
  return light;
}

Scene plate_over_floor() {
  Scene scene;
  add(scene, Plate{-1.1, -0.9, 1.2, 1.3, 4});
  add(scene, Plate{-20, -20, 20, 20, 8});
  return scene;
}

const ModelledFeature& feature(const BakedFunctions& baked, const std::string& name) {
  const auto& list = baked.report().modelled;
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& f) { return f.feature == name; });
  if (found == list.end()) throw std::runtime_error("no feature " + name);
  return *found;
}

/// The same bytes for the same rays and events.
void expect_same_cost(const BakedFunctions& a, const BakedFunctions& b) {
  expect_same_bytes(a, b);
  EXPECT_EQ(a.report().rays, b.report().rays);
  EXPECT_EQ(a.report().events, b.report().events);
  EXPECT_EQ(a.report().pieces, b.report().pieces);
}

TEST(ModelOnly, CastersThatCanReachNoRayCostNothing) {
  const BakeOptions options = small_options(96, 80, 16);
  const BakedFunctions plain(plate_over_floor(), key_light(), options);
  Scene scene = plate_over_floor();
  add(scene, Plate{-9, -9, 9, 9, -3}, Roles::caster);       // behind the light
  add(scene, Plate{30, 30, 40, 40, 5}, Roles::caster);      // beside the hull of light and window
  add(scene, Plate{-15, -15, 15, 15, 8.5}, Roles::caster);  // behind far
  expect_same_cost(plain, {scene, key_light(), options});
}

TEST(ModelOnly, ReceiversOutsideTheWindowCostNothing) {
  const BakeOptions options = small_options(96, 80, 16);
  const BakedFunctions plain(plate_over_floor(), key_light(), options);
  Scene scene = plate_over_floor();
  add(scene, Plate{30, 30, 40, 40, 5}, Roles::receiver);
  expect_same_cost(plain, {scene, key_light(), options});
}

TEST(ModelOnly, GentleSlopesAreLimitedWhereReceiversLieCloseBehind) {
  // A sheet that rises by 3 m in 4 m, over a floor that is parallel to it or far below. A texel's footprint
  // at far is 8 / 40 m: the slope adds up to about 3/4 of that, less than four footprints.
  const BakeOptions options = small_options(40, 40, 9);
  const auto sheet_over = [](double gap) {
    const auto corner = [](double x, double y, double z) { return glm::dvec3(x, y, z + 0.75 * x); };
    Scene scene;
    for (const double z : {4.0, 4 + gap})
      add(scene, quad_mesh(corner(-2, -9, z), corner(2, -9, z), corner(2, 9, z), corner(-2, 9, z)));
    return scene;
  };
  const char* name = "bias of slopes before receivers";
  EXPECT_TRUE(feature({sheet_over(0.2), key_light(), options}, name).modelled);
  const BakedFunctions far(sheet_over(2), key_light(), options);
  EXPECT_FALSE(feature(far, name).modelled);
  EXPECT_EQ(feature(far, name).saved, "9 maps of second rays");
}

TEST(ModelOnly, MapsAreTracedWhereCastersReachTheLight) {
  const BakeOptions options = small_options(40, 40, 9);
  const char* name = "tracing of shadow maps";
  const auto with_wall = [&](double x) {
    Scene scene = plate_over_floor();
    add(scene, quad_mesh({x, -1, -1}, {x, 1, -1}, {x, 1, 7}, {x, -1, 7}));
    return BakedFunctions(scene, key_light(), options);
  };
  const BakedFunctions projected(plate_over_floor(), key_light(), options);
  EXPECT_FALSE(feature(projected, name).modelled);
  EXPECT_EQ(feature(projected, name).saved, "9 traced maps");
  // A wall that passes the light: its edge at the emitter is seen under a slope of 1e4, but in no map.
  EXPECT_FALSE(feature(with_wall(2), name).modelled);
  // One that goes through the light.
  EXPECT_TRUE(feature(with_wall(0.1), name).modelled);
  Scene wide = plate_over_floor();
  add(wide, Plate{-1e6, -1e6, 1e6, 1e6, 9});
  EXPECT_FALSE(feature({wide, key_light(), options}, name).modelled);
}

TEST(ModelOnly, RaysThatNothingCanDarkenAreNotTraced) {
  // A plate over a corner of the window leaves cells far from it alone.
  Scene scene;
  add(scene, Plate{-3, -3, -0.5, -0.5, 6});
  add(scene, Plate{-20, -20, 20, 20, 8});
  const BakedFunctions baked(scene, key_light(), small_options(128, 128, 16));
  const ModelledFeature& left_out = feature(baked, "rays that nothing can darken");
  EXPECT_FALSE(left_out.modelled);
  const std::uint64_t saved = std::stoull(left_out.saved);
  EXPECT_GT(saved, 16u * 128 * 128 / 4);
  EXPECT_LT(baked.report().rays, 16u * 128 * 128 - saved / 2);
  // Whatever was left out is lit, and whoever is in shadow was not left out.
  EXPECT_LE(saved / 16, baked.report().empty_texels);
}

TEST(ModelOnly, ANarrowCodingIsTakenWhereItServes) {
  const BakedFunctions coarse(plate_over_floor(), key_light(), small_options(64, 64, 16));
  EXPECT_EQ(coarse.map().coding.words_per_vertex(), 1u);
  // One word a vertex: a second one would hold 32-bit depths or 16-bit values.
  const std::string saved = std::to_string(4 * coarse.report().pieces) + " bytes of vertices";
  for (const char* name : {"depths of 32 bits", "values beyond 8 bits"}) {
    EXPECT_FALSE(feature(coarse, name).modelled) << name;
    EXPECT_EQ(feature(coarse, name).saved, saved) << name;
  }
  // Three channels are functions of their own.
  EXPECT_FALSE(feature(coarse, "colour").modelled);
  EXPECT_EQ(feature(coarse, "colour").saved,
            std::to_string(2 * 4 * coarse.report().pieces) + " bytes of vertices");
  BakeOptions options = small_options(64, 64, 16);
  options.epsilon = 0.005;
  options.depth_tolerance = 1e-6;
  const BakedFunctions fine(plate_over_floor(), key_light(), options);
  EXPECT_TRUE(feature(fine, "depths of 32 bits").modelled);
  EXPECT_TRUE(feature(fine, "values beyond 8 bits").modelled);
  EXPECT_EQ(feature(fine, "values beyond 8 bits").saved, "");
}

TEST(ModelOnly, TheGeneralPathRunsForLiftedSamplesAlone) {
  BakeOptions options = small_options(64, 64, 4);
  const BakedFunctions planar(plate_over_floor(), key_light(), options);
  EXPECT_FALSE(feature(planar, "general scan conversion").modelled);
  EXPECT_EQ(feature(planar, "general scan conversion").saved,
            std::to_string((64 * 64 - 1) * 4) + " conversions of a ray");
  options.light_samples = planar.map().samples;
  options.light_samples[2].position[2] = 0.01;
  const BakedFunctions lifted(plate_over_floor(), key_light(), options);
  EXPECT_TRUE(feature(lifted, "general scan conversion").modelled);
}

TEST(ModelOnly, MipLevelsAreMadeWhenAskedForAlone) {
  BakeOptions options = small_options(64, 64, 4);
  const BakedFunctions none(plate_over_floor(), key_light(), options);
  // 32^2 + 16^2 + 8^2 + 4^2 + 2^2 + 1
  EXPECT_EQ(feature(none, "mip levels").saved, "1365 functions");
  EXPECT_EQ(none.map().images.size(), 1u);
  options.mip_levels = 6;
  const BakedFunctions all(plate_over_floor(), key_light(), options);
  EXPECT_TRUE(feature(all, "mip levels").modelled);
  EXPECT_EQ(all.report().rays, none.report().rays);
  EXPECT_EQ(all.report().events, none.report().events);
}

TEST(ModelOnly, EveryFeatureHasAReason) {
  const BakedFunctions baked({}, key_light(), small_options(8, 8, 4));
  for (const ModelledFeature& f : baked.report().modelled) {
    EXPECT_FALSE(f.reason.empty()) << f.feature;
    EXPECT_TRUE(!f.modelled || f.saved.empty()) << f.feature;
  }
}

}  // namespace
}  // namespace pdsm::test
