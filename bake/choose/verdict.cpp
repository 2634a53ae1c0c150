// SPDX-License-Identifier: Apache-2.0
#include "choose/verdict.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// Standard errors between a measurement and the target: one other measurement of 15 goes beyond when a map
/// is only just accepted. What is aimed at leaves more room, so that the laws may err and few bakes be
/// wasted.
constexpr double kSigmas = 1.5, kAimSigmas = 2.25;
/// Share of the target that is aimed at, margin included.
constexpr double kAimShare = 0.95;
/// Nobody asked for an error below this share of the target.
constexpr double kNeverBelow = 1.0 / 3;
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
  // a + c sqrt(a) = share * target, solved for sqrt(a).
  const double mean = seen.mean_abs_error();
  if (!(mean > 0)) return kAimShare * target;
  const double c = kAimSigmas / kSigmas * error_margin(seen) / std::sqrt(mean);
  const double root = 0.5 * (std::sqrt(c * c + 4 * kAimShare * target) - c);
  return std::max(kLeastAim * target, root * root);
}

std::uint32_t truth_samples_for(double target, const Trial& seen, std::uint32_t seen_samples) {
  const double too_much = seen.error.truth_standard_error / (kTruthShare * target);
  const double wanted = seen_samples * std::pow(std::max(too_much, 1e-3), 1 / kTruthPower);
  const double least = VerifyOptions{}.samples;
  return static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), least, kMostTruthSamples));
}

}  // namespace pdsm
