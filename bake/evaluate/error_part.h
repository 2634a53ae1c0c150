// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "evaluate/probed_truth.h"

namespace pdsm {

/// One cause of error: what attenuations change by when it is let in. Over the same points and with the same
/// divisor as VerifyResult's.
struct ErrorPart {
  double rms = 0;       ///< sqrt(sum change^2 / shadowed_points)
  double mean_abs = 0;  ///< sum |change| / shadowed_points
  double bias = 0;      ///< sum change / shadowed_points; > 0: too dark
};

/// What a cause changes at each point of `truth`, summed up.
[[nodiscard]] ErrorPart sum_up(std::span<const double> changes, const ProbedTruth& truth);

}  // namespace pdsm
