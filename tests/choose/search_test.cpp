// SPDX-License-Identifier: Apache-2.0
#include "choose/search.h"

#include <gtest/gtest.h>

#include "plates.h"

namespace pdsm {
namespace {

/// A plate between a square light and a floor: penumbrae everywhere, nothing edge-on.
Scene plate_over_floor() {
  Scene scene;
  scene.lights = {light_at_origin(RectLight{1, 1})};
  scene.geometry = {plate(-0.5, -0.5, 0.5, 0.5, 4), plate(-4, -4, 4, 4, 8)};
  return scene;
}

ChosenBake choose(const Goals& goals, const FixedOptions& fixed = {}, const BakeOptions& options = {}) {
  const Scene scene = plate_over_floor();
  return choose_bake(scene, scene.lights[0], options, fixed, goals);
}

/// As anyone would measure it: verify()'s own seed and number of points.
VerifyResult measure_anew(const ChosenBake& chosen) {
  const Scene scene = plate_over_floor();
  return verify(decode_blocks(chosen.baked), scene, scene.lights[0]);
}

TEST(Search, TheTargetIsReachedAndNotOvershot) {
  double last_work = 0;
  for (const double target : {0.03, 0.01}) {
    const ChosenBake chosen = choose({.target_error = target});
    const VerifyResult result = measure_anew(chosen);
    EXPECT_LE(result.mean_abs_error, target);
    EXPECT_GE(result.mean_abs_error, target / 3);
    // What is told is what was measured, at other points.
    EXPECT_NEAR(chosen.chosen.mean_abs_error(), result.mean_abs_error,
                4 * std::hypot(chosen.chosen.standard_error, standard_error(result)));
    EXPECT_EQ(chosen.chosen.settings, settings_of(chosen.options));
    EXPECT_EQ(chosen.chosen.bytes, encoded_map_bytes(chosen.baked.map, chosen.baked.blocks));
    // A tighter target costs more.
    const double work = chosen.chosen.settings.work();
    EXPECT_GT(work, last_work);
    last_work = work;
  }
}

TEST(Search, TheSizeIsHeldAndUsed) {
  constexpr std::uint64_t kBudget = 60'000;
  const ChosenBake chosen = choose({.size_budget = kBudget});
  EXPECT_LE(chosen.chosen.bytes + kMetadataBytes, kBudget);
  EXPECT_GE(chosen.chosen.bytes + kMetadataBytes, 0.8 * static_cast<double>(kBudget));
}

TEST(Search, FixedOptionsAreKept) {
  BakeOptions options;
  options.samples = 100;
  options.epsilon = 0.015;
  const ChosenBake chosen = choose({.target_error = 0.02}, {.samples = true, .epsilon = true}, options);
  EXPECT_EQ(chosen.options.samples, 100U);
  EXPECT_EQ(chosen.options.epsilon, 0.015);
  EXPECT_LE(measure_anew(chosen).mean_abs_error, 0.02);
}

TEST(Search, TheTimeIsPlannedFor) {
  // The clock itself can't be promised on a busy machine; the plan can: what had been spent when the last
  // bake began, and what was expected of it, are within the budget.
  constexpr double kSeconds = 6;
  const ChosenBake chosen = choose({.time_budget = kSeconds});
  double spent = 0;
  for (const Trial& trial : chosen.trials) spent += trial.seconds();
  EXPECT_EQ(chosen.trials.back().settings, chosen.chosen.settings);
  EXPECT_LE(spent - chosen.chosen.seconds() + chosen.expected_seconds, kSeconds);
  EXPECT_GT(chosen.expected_seconds, 0);
}

std::string why_missed(const Goals& goals, const FixedOptions& fixed = {}, const BakeOptions& options = {}) {
  try {
    (void)choose(goals, fixed, options);
  } catch (const GoalMissed& missed) {
    return missed.what();
  }
  return "reached";
}

TEST(Search, SaysWhichGoalIsInTheWay) {
  const auto begins = [](const std::string& line, const std::string& with) {
    return line.rfind(with + ": ", 0) == 0;
  };
  EXPECT_TRUE(begins(why_missed({.target_error = 1e-6}), "--target-error"));
  EXPECT_TRUE(begins(why_missed({.target_error = 0.005, .size_budget = 4000}), "--size-budget"));
  EXPECT_TRUE(begins(why_missed({.size_budget = 2500}), "--size-budget"));
  EXPECT_TRUE(begins(why_missed({.target_error = 0.002, .time_budget = 0.5}), "--time-budget"));
}

TEST(Search, TellsHowFarItGot) {
  BakeOptions options;
  options.width = options.height = 16;
  options.epsilon = 0.2;
  const std::string line =
      why_missed({.target_error = 0.005}, {.resolution = true, .epsilon = true}, options);
  EXPECT_EQ(line.rfind("--target-error: ", 0), 0U) << line;
  EXPECT_NE(line.find("16 x 16"), std::string::npos) << line;
}

TEST(Search, SurfaceMapsAreMeasuredOnSurfaces) {
  BakeOptions options;
  options.receivers = Receivers::surfaces;
  const ChosenBake chosen = choose({.target_error = 0.03}, {}, options);
  EXPECT_EQ(chosen.chosen.error.points, chosen.chosen.error.surface_points);
}

TEST(Search, ALightThatNothingDarkensIsCheap) {
  Scene scene = plate_over_floor();
  scene.geometry.erase(scene.geometry.begin());
  const ChosenBake chosen = choose_bake(scene, scene.lights[0], {}, {}, {.target_error = 0.01});
  EXPECT_EQ(chosen.chosen.mean_abs_error(), 0);
  EXPECT_EQ(chosen.options.samples, 64U);  // the fewest that are chosen
}

TEST(Search, CancellingEndsIt) {
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
