// SPDX-License-Identifier: Apache-2.0
// Smooth transmittance as steps whose mean over light samples is smooth again.
#include "trace/volume_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random.h"

namespace pdsm::test {
namespace {

/// The mean over samples of the share taken, in steps, where sample n has lost taken(n).
template <typename Taken>
double mean_in_steps(std::uint32_t steps, std::uint32_t samples, Taken&& taken) {
  const VolumeSteps all(steps, samples);
  std::vector<double> depths;
  double sum = 0;
  for (std::uint32_t n = 0; n < samples; ++n) {
    all.list(n, depths);
    const double depth = -std::log1p(-taken(n));
    for (const double step : depths) sum += step <= depth ? 1.0 / steps : 0.0;
  }
  return sum / samples;
}

/// Where all samples lose the same, their steps are the lattice (i + 1/2) / Nm.
TEST(VolumeSteps, OfLikeRaysAreAsFineAsAllTogether) {
  for (const std::uint32_t samples : {1U, 7U, 64U, 256U}) {
    for (const std::uint32_t steps : {1U, 4U, 9U}) {
      for (double taken = 0; taken < 1; taken += 0.0137)
        EXPECT_NEAR(mean_in_steps(steps, samples, [&](std::uint32_t) { return taken; }), taken,
                    0.5 / (samples * steps) + 1e-12)
            << samples << " samples, " << steps << " steps";
    }
  }
}

/// A ray is off by at most 1 / m, and where its place among the steps is random by 1 / (m sqrt(6)) rms: the
/// mean over N independent rays by 1 / (m sqrt(6 N)). Over 400 means the rms of Gaussian errors is within
/// 1 + 5 / sqrt(800) of that, with a chance of 3e-7.
TEST(VolumeSteps, OfUnlikeRaysErrNoMoreThanIndependentOnes) {
  Random random(7);
  for (const std::uint32_t steps : {2U, 4U, 16U}) {
    constexpr std::uint32_t kSamples = 64;
    constexpr int kMeans = 400;
    double squares = 0;
    for (int n = 0; n < kMeans; ++n) {
      std::vector<double> taken(kSamples);
      double mean = 0;
      for (double& x : taken) mean += (x = random.uniform()) / kSamples;
      const double error = mean_in_steps(steps, kSamples, [&](std::uint32_t s) { return taken[s]; }) - mean;
      squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / kMeans),
              (1 + 5 / std::sqrt(2.0 * kMeans)) / (steps * std::sqrt(6.0 * kSamples)))
        << steps << " steps";
  }
}

TEST(VolumeSteps, AreAsManyAsEpsilonNeeds) {
  for (const double epsilon : {0.005, 0.01, 0.02, 0.05}) {
    for (const std::uint32_t samples : {16U, 64U, 256U, 4096U}) {
      const std::uint32_t steps = choose_volume_steps(epsilon, samples);
      EXPECT_LE(1 / (steps * std::sqrt(6.0 * samples)), epsilon / 3);
      EXPECT_TRUE(steps == kLeastVolumeSteps || 1 / ((steps - 1) * std::sqrt(6.0 * samples)) > epsilon / 3);
    }
  }
}

}  // namespace
}  // namespace pdsm::test
