// SPDX-License-Identifier: Apache-2.0
#include "choose/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pdsm {
namespace {

/// A trial at as many points as verify() takes.
Trial measured(double error, double standard_error) {
  Trial trial;
  trial.error.mean_abs_error = error;
  trial.error.points = VerifyOptions{}.points;
  trial.standard_error = standard_error;
  return trial;
}

TEST(Verdict, LeavesRoomForOthersPoints) {
  EXPECT_EQ(judge(0.01, measured(0.0099, 0)), Verdict::reached);
  EXPECT_EQ(judge(0.01, measured(0.0101, 0)), Verdict::too_high);
  EXPECT_EQ(judge(0.01, measured(0.0099, 0.001)), Verdict::too_high);
  EXPECT_EQ(judge(0.01, measured(0.0032, 0)), Verdict::too_good);
  EXPECT_EQ(judge(0.01, measured(0.0034, 0)), Verdict::reached);
}

TEST(Verdict, TheMarginIsOfBothMeasurements) {
  // As many points there as here: the difference of both varies by sqrt(2).
  EXPECT_NEAR(error_margin(measured(0.01, 0.001)), 1.5 * std::sqrt(2.0) * 0.001, 1e-12);
  // Infinitely many here: theirs alone.
  Trial certain = measured(0.01, 1e-6);
  certain.error.points = 4'000'000'000;
  EXPECT_NEAR(error_margin(certain), 1.5e-6 * 1000, 1e-8);
}

TEST(Verdict, WhatIsAimedAtIsAccepted) {
  for (const double target : {0.1, 0.01, 0.003}) {
    for (const double error : {0.3, 0.01, 0.002}) {
      for (const double scatter : {0.0, 0.02, 0.1}) {
        // The standard error goes with the power 2/3 of the error.
        const double aim = aim_for(target, measured(error, scatter * error));
        const Trial at_aim = measured(aim, scatter * error * std::pow(aim / error, 2.0 / 3));
        EXPECT_LE(aim, target);
        EXPECT_GE(aim, target / 3);
        if (aim <= 0.45 * target) continue;  // so much scatter that the target can't be met with certainty
        EXPECT_NE(judge(target, at_aim), Verdict::too_high) << target << " " << error;
      }
    }
  }
}

TEST(Verdict, TheTruthIsFineEnough) {
  Trial trial = measured(0.01, 0.001);
  trial.error.truth_standard_error = 0.002;
  // Rays needed for a sixth of the target: 2048 (0.002 / (target / 6))^(4/3), never fewer than verify()'s.
  EXPECT_EQ(truth_samples_for(0.05, trial, 2048), VerifyOptions{}.samples);
  EXPECT_NEAR(truth_samples_for(0.003, trial, 2048), 2048 * std::pow(4, 4.0 / 3), 1);
}

TEST(Trial, StandardErrorIsThatOfAMean) {
  // Errors of 0.1 at each of 100 points in shadow have no scatter; 1 at one of them has.
  VerifyResult result;
  result.shadowed_points = 100;
  result.mean_abs_error = result.rms_error = 0.1;
  EXPECT_NEAR(standard_error(result), 0, 1e-9);
  result.mean_abs_error = 0.01;
  result.rms_error = 0.1;
  EXPECT_NEAR(standard_error(result), std::sqrt(0.01 - 0.0001) / 10, 1e-12);
  EXPECT_EQ(standard_error({}), 0);
}

}  // namespace
}  // namespace pdsm
