// SPDX-License-Identifier: Apache-2.0
#include "choose/verdict.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// Standard errors between a measurement and the target: one other measurement of 15 goes beyond when a map
/// is only just accepted. What is aimed at leaves more room, so that the laws may err and few bakes be
/// wasted.
constexpr double kSigmas = 1.5, kAimSigmas = 2;
/// Nobody asked for an error below this share of the target.
constexpr double kNeverBelow = 1.0 / 3;
/// Standard errors go with this power of the error: what falls are both the number and the size of errors.
constexpr double kScatterPower = 2.0 / 3;
/// The aim stays this far above that.
constexpr double kLeastAim = 0.45;
/// The truth's own error is at most this share of the target.
constexpr double kTruthShare = 1.0 / 6;
/// Error of jittered shadow rays ~ rays^-3/4.
constexpr double kTruthPower = 0.75;
constexpr double kMostTruthSamples = 65536;

}  // namespace

double error_margin(const Trial& trial) {
  // Their points and ours err independently.
  const double more = static_cast<double>(trial.error.points) / VerifyOptions{}.points;
  return kSigmas * trial.standard_error * std::sqrt(1 + more);
}

Verdict judge(double target, const Trial& trial) {
  const double mean = trial.mean_abs_error(), margin = error_margin(trial);
  if (mean + margin > target) return Verdict::too_high;
  return mean - margin / kSigmas < kNeverBelow * target ? Verdict::too_good : Verdict::reached;
}

double aim_for(double target, const Trial& seen) {
  const double mean = seen.mean_abs_error(), room = target;
  if (!(mean > 0)) return room;
  // The try is judged at more points than `seen`.
  const double per_point = seen.standard_error * std::sqrt(static_cast<double>(seen.error.points));
  const double margin =
      kAimSigmas * per_point * std::sqrt(1.0 / kJudgingPoints + 1.0 / VerifyOptions{}.points);
  // The largest aim that has room for its margin, by halving: both rise with the aim.
  double low = kLeastAim * target, high = room;
  for (int round = 0; round < 40; ++round) {
    const double aim = 0.5 * (low + high);
    (aim + margin * std::pow(aim / mean, kScatterPower) <= room ? low : high) = aim;
  }
  return low;
}

std::uint32_t truth_samples_for(double target, const Trial& seen, std::uint32_t seen_samples) {
  const double too_much = seen.error.truth_standard_error / (kTruthShare * target);
  const double wanted = seen_samples * std::pow(std::max(too_much, 1e-3), 1 / kTruthPower);
  const double least = VerifyOptions{}.samples;
  return static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), least, kMostTruthSamples));
}

}  // namespace pdsm
