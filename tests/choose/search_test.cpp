// SPDX-License-Identifier: Apache-2.0
#include "choose/search.h"

#include <gtest/gtest.h>

#include <set>

#include "choose/verdict.h"
#include "known_laws.h"

namespace pdsm {
namespace {

/// A scene whose resolution part is `at_512` at 512^2 texels and falls with `power`.
KnownLaws scene_of(double at_512, double power, double sampling = 0.1) {
  KnownLaws laws;
  laws.resolution_power = power;
  laws.resolution = at_512 * std::pow(512, power);
  laws.sampling = sampling;
  laws.scatter = 2;  // the house: 0.0005 of 0.005 at 8,000 points
  return laws;
}

std::size_t tries_of(const ChosenBake& chosen) {
  const auto is_try = [](const Trial& trial) { return trial.purpose.starts_with("try "); };
  return static_cast<std::size_t>(std::count_if(chosen.trials.begin(), chosen.trials.end(), is_try));
}

TEST(Search, TargetsAreReachedAndNotOvershotWithFewBakes) {
  for (const double at_512 : {0.002, 0.015, 0.06}) {
    for (const double power : {0.5, 0.8, 1.1}) {
      for (const double sampling : {0.02, 0.1, 0.4}) {
        for (const double target : {0.03, 0.01}) {
          const KnownLaws scene = scene_of(at_512, power, sampling);
          // Beyond kMostWork.
          if (0.75 * at_512 * std::pow(6, -power) > 0.3 * target) continue;
          SCOPED_TRACE(testing::Message() << at_512 << " " << power << " " << sampling << " " << target);
          const ChosenBake chosen = scene.search({.target_error = target});
          const double error = scene.error(settings_of(chosen.options));
          EXPECT_LE(error, target);
          EXPECT_GE(error, target / 3);
          EXPECT_LE(chosen.trials.size(), 9U);
          // No bake takes much more than the result and what was looked at anyway.
          const double star = 4 * 64 * 256 * 256;
          for (const Trial& trial : chosen.trials)
            EXPECT_LE(trial.settings.work(), std::max(star, 2 * chosen.chosen.settings.work()));
        }
      }
    }
  }
}

/// The star sees a power of 1, the larger bakes one of 0.4.
KnownLaws bent_scene() {
  KnownLaws scene = scene_of(0.03, 1);
  scene.bend = 600;
  return scene;
}

TEST(Search, ALawThatBendsIsFollowed) {
  const KnownLaws scene = bent_scene();
  const ChosenBake chosen = scene.search({.target_error = 0.015});
  const double error = scene.error(settings_of(chosen.options));
  EXPECT_LE(error, 0.015);
  EXPECT_GE(error, 0.015 / 3);
  EXPECT_GE(tries_of(chosen), 2U);  // it was not right at once
}

TEST(Search, TriesAreJudgedAtTheirOwnPoints) {
  const KnownLaws scene = bent_scene();
  std::multiset<std::uint64_t> seeds;
  (void)search({{}, {}, {.target_error = 0.015}, 1}, [&](const std::string& purpose, const Settings& s,
                                                         const VerifyOptions& measure, TrialAim aim) {
    const bool is_try = purpose.starts_with("try ");
    if (is_try) seeds.insert(measure.seed);
    EXPECT_EQ(seeds.count(measure.seed), is_try ? 1U : 0U) << purpose;
    EXPECT_EQ(measure.points, is_try ? kJudgingPoints : 3000U);
    EXPECT_EQ(aim == TrialAim::sampling, purpose == "trial");
    EXPECT_EQ(aim == TrialAim::result, is_try);
    return scene.run(purpose, s, measure);
  });
  EXPECT_GE(seeds.size(), 2U);
}

TEST(Search, SurfaceMapsAreMeasuredOnSurfaces) {
  const KnownLaws scene = scene_of(0.02, 0.8);
  for (const Receivers receivers : {Receivers::surfaces, Receivers::volume}) {
    BakeOptions options;
    options.receivers = receivers;
    (void)search({options, {}, {.target_error = 0.02}, 1},
                 [&](const std::string& purpose, const Settings& s, const VerifyOptions& measure, TrialAim) {
                   EXPECT_EQ(measure.free_space, receivers == Receivers::volume) << purpose;
                   return scene.run(purpose, s, measure);
                 });
  }
}

TEST(Search, TheRecordIsOfTheChosenBake) {
  const KnownLaws scene = scene_of(0.02, 0.8);
  const ChosenBake chosen = scene.search({.target_error = 0.01});
  EXPECT_EQ(chosen.chosen.settings, settings_of(chosen.options));
  EXPECT_EQ(chosen.chosen.error.points, chosen.measured_by.points);
  EXPECT_NEAR(chosen.expected_error, chosen.chosen.mean_abs_error(), 0.002);
  EXPECT_FALSE(chosen.why.empty());
}

TEST(Search, ALightThatNothingDarkensIsCheap) {
  KnownLaws none;
  none.sampling = none.resolution = none.fit = 0;
  const ChosenBake chosen = none.search({.target_error = 0.01});
  EXPECT_EQ(chosen.chosen.mean_abs_error(), 0);
  EXPECT_EQ(chosen.options.samples, 64U);  // the fewest that are chosen
  EXPECT_LT(chosen.options.width, 256U);
}

TEST(Search, TheSizeIsHeldAndUsed) {
  // The files of tries are larger than the laws tell.
  const KnownLaws scene = scene_of(0.02, 0.8);
  const RunTrial run = [&](const std::string& purpose, const Settings& s, const VerifyOptions& measure,
                           TrialAim) {
    TrialBake result = scene.run(purpose, s, measure);
    if (purpose.starts_with("try ")) result.trial.bytes += result.trial.bytes / 8;
    return result;
  };
  for (const std::uint64_t budget : {60'000U, 600'000U, 6'000'000U}) {
    const ChosenBake chosen = search({{}, {}, {.size_budget = budget}, 1}, run);
    EXPECT_LE(chosen.chosen.bytes + kMetadataBytes, budget);
    EXPECT_GE(chosen.chosen.bytes + kMetadataBytes, 0.8 * static_cast<double>(budget));
  }
}

TEST(Search, TimeIsHeldAndUsed) {
  for (const double budget : {5.0, 30.0, 300.0}) {
    const ChosenBake chosen = scene_of(0.02, 0.8).search({.time_budget = budget});
    double spent = 0;
    for (const Trial& trial : chosen.trials) spent += trial.seconds();
    EXPECT_LE(spent, budget);
    EXPECT_GE(spent, 0.4 * budget);
  }
}

TEST(Search, FixedOptionsAreKept) {
  BakeOptions options;
  options.samples = 100;
  options.epsilon = 0.015;
  options.map_width = options.map_height = 700;
  const FixedOptions fixed{.samples = true, .epsilon = true, .map_resolution = true};
  const ChosenBake chosen = scene_of(0.02, 0.8).search({.target_error = 0.02}, fixed, options);
  EXPECT_EQ(chosen.options.samples, 100U);
  EXPECT_EQ(chosen.options.epsilon, 0.015);
  EXPECT_EQ(chosen.options.map_width, 700U);
  EXPECT_NE(chosen.options.width, 700U);
  for (const Trial& trial : chosen.trials) EXPECT_EQ(trial.settings.maps_per_texel, 0U) << trial.purpose;
}

TEST(Search, WhatMemoryRefusesIsLeftOut) {
  KnownLaws scene = scene_of(0.02, 0.8);
  const double wanted = scene.search({.target_error = 0.01}).chosen.settings.edge();
  scene.most_edge = 0.95 * wanted;
  const ChosenBake chosen = scene.search({.target_error = 0.01});
  EXPECT_LE(chosen.chosen.settings.edge(), scene.most_edge);
  EXPECT_LE(scene.error(chosen.chosen.settings), 0.01);
}

std::string why_missed(const KnownLaws& scene, const Goals& goals, const FixedOptions& fixed = {},
                       const BakeOptions& options = {}) {
  try {
    (void)scene.search(goals, fixed, options);
  } catch (const GoalMissed& missed) {
    return missed.what();
  }
  return "reached";
}

TEST(Search, SaysWhichGoalIsInTheWay) {
  const KnownLaws scene = scene_of(0.02, 0.8);
  const auto begins = [](const std::string& line, const std::string& with) {
    EXPECT_TRUE(line.starts_with(with + ": ")) << line;
  };
  begins(why_missed(scene, {.target_error = 1e-5}), "--target-error");
  begins(why_missed(scene, {.target_error = 0.015, .size_budget = 4000}), "--size-budget");
  begins(why_missed(scene, {.size_budget = 2500}), "--size-budget");
  begins(why_missed(scene, {.target_error = 0.002, .time_budget = 2}), "--time-budget");
  KnownLaws small = scene;
  small.most_edge = 600;
  const std::string line = why_missed(small, {.target_error = 0.007});
  begins(line, "--target-error");
  EXPECT_NE(line.find("--memory"), std::string::npos) << line;
}

TEST(Search, WorkIsBoundedUnlessATimeBudgetIs) {
  KnownLaws scene = scene_of(0.06, 0.8);
  scene.scatter = 0;
  double most = 0;
  const RunTrial run = [&](const std::string& purpose, const Settings& s, const VerifyOptions& measure,
                           TrialAim) {
    most = std::max(most, s.work());
    return scene.run(purpose, s, measure);
  };
  EXPECT_THROW((void)search({{}, {}, {.target_error = 0.006}, 1}, run), GoalMissed);
  EXPECT_LE(most, kMostWork);
  const ChosenBake chosen = search({{}, {}, {.target_error = 0.006, .time_budget = 1e6}, 1}, run);
  EXPECT_LE(scene.error(chosen.chosen.settings), 0.006);
  EXPECT_GT(most, kMostWork);
}

TEST(Search, TellsHowFarItGot) {
  BakeOptions options;
  options.width = options.height = 16;
  options.epsilon = 0.2;
  const std::string line = why_missed(scene_of(0.02, 0.8), {.target_error = 0.005},
                                      {.resolution = true, .epsilon = true}, options);
  EXPECT_TRUE(line.starts_with("--target-error: ")) << line;
  EXPECT_NE(line.find("16 x 16"), std::string::npos) << line;
}

TEST(Search, OtherTroubleIsNotMistakenForMemory) {
  const KnownLaws scene = scene_of(0.02, 0.8);
  const RunTrial run = [&](const std::string& purpose, const Settings& s, const VerifyOptions& measure,
                           TrialAim) {
    if (purpose == "try 1") throw Error(Failure::resource, "embree", "no device");
    return scene.run(purpose, s, measure);
  };
  EXPECT_THROW((void)search({{}, {}, {.target_error = 0.01}, 1}, run), Error);
}

}  // namespace
}  // namespace pdsm
