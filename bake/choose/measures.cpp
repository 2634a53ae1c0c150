// SPDX-License-Identifier: Apache-2.0
#include "choose/measures.h"

#include "choose/verdict.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kTrialPoints = 3000, kTrialRays = 2048;
/// Seeds that nobody would pass to verify.
constexpr std::uint64_t kTrialSeed = 0x7472'6961'6c00, kJudgingSeed = 0x6a75'6467'6500;

}  // namespace

VerifyOptions trial_measure(const BakeOptions& options) {
  VerifyOptions measure;
  measure.points = kTrialPoints;
  measure.samples = kTrialRays;
  measure.seed = kTrialSeed;
  measure.free_space = options.receivers != Receivers::surfaces;
  return measure;
}

VerifyOptions judging_measure(const BakeOptions& options, const Goals& goals, std::size_t index,
                              const Trial& last, std::uint32_t last_rays) {
  VerifyOptions measure = trial_measure(options);
  measure.seed = kJudgingSeed + index;
  if (goals.time_budget) return measure;
  measure.points = kJudgingPoints;
  measure.samples =
      goals.target_error ? truth_samples_for(*goals.target_error, last, last_rays) : VerifyOptions{}.samples;
  return measure;
}

}  // namespace pdsm
