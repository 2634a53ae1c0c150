// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "choose/trial.h"

namespace pdsm {

/// What a measured map says about a target error.
enum class Verdict {
  reached,   ///< others who measure it with verify()'s default number of points find the target held
  too_high,  ///< they may not
  too_good   ///< they may find it less than a third of the target: more was paid than was asked for
};

/// Points that a try is judged at: twice as many as verify() takes.
inline constexpr std::uint32_t kJudgingPoints = 2 * VerifyOptions{}.points;

[[nodiscard]] Verdict judge(double target, const Trial& trial);

/// By how much others' figure may be above this trial's: their points are others, and fewer.
[[nodiscard]] double error_margin(const Trial& trial);

/// The error to aim at, so that the target holds with its margin. `seen` tells how much the scene's errors
/// scatter, which falls with them.
[[nodiscard]] double aim_for(double target, const Trial& seen);

/// Shadow rays a point of the truth that do not cover up the target: as many as verify() takes, or more
/// where `seen` tells that their own error counts.
[[nodiscard]] std::uint32_t truth_samples_for(double target, const Trial& seen, std::uint32_t seen_samples);

}  // namespace pdsm
