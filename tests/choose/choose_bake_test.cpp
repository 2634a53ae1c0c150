// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "choose/search.h"
#include "plates.h"

/// Goals with real bakes: search_test.cpp has everything that known laws can show.
namespace pdsm {
namespace {

/// A plate between a square light and a floor: penumbrae everywhere, nothing edge-on.
Scene plate_over_floor() {
  Scene scene;
  scene.lights = {light_at_origin(RectLight{1, 1})};
  scene.geometry = {plate(-0.5, -0.5, 0.5, 0.5, 4), plate(-4, -4, 4, 4, 8)};
  return scene;
}

TEST(ChooseBake, OthersFindTheTargetHeld) {
  constexpr double kTarget = 0.03;
  const Scene scene = plate_over_floor();
  const ChosenBake chosen = choose_bake(scene, scene.lights[0], {}, {}, {.target_error = kTarget});
  const VerifyResult result = verify(decode_blocks(chosen.baked), scene, scene.lights[0]);
  EXPECT_LE(result.mean_abs_error, kTarget);
  EXPECT_GE(result.mean_abs_error, kTarget / 3);
  // What is told is what was measured, at other points.
  EXPECT_NEAR(chosen.chosen.mean_abs_error(), result.mean_abs_error,
              4 * std::hypot(chosen.chosen.standard_error, standard_error(result)));
  EXPECT_EQ(chosen.chosen.bytes, encoded_map_bytes(chosen.baked.map, chosen.baked.blocks));
}

TEST(ChooseBake, CancellingEndsIt) {
  const Scene scene = plate_over_floor();
  TrialCallbacks callbacks;
  int begun = 0;
  callbacks.begin = [&](const std::string&) { ++begun; };
  callbacks.bake.cancelled = [&] { return begun > 1; };
  EXPECT_ANY_THROW((void)choose_bake(scene, scene.lights[0], {}, {}, {.target_error = 0.01}, callbacks));
  EXPECT_EQ(begun, 2);
}

}  // namespace
}  // namespace pdsm
