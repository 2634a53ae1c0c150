// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "events/accumulate.h"
#include "fit/fit_rules.h"

namespace pdsm {

/// A line by its values at the two ends of a piece, in scaled value codes.
struct PieceLine {
  double begin = 0, end = 0;
};

/// The line nearest to V in the mean square over depth codes [begin, end]. `segment` is where to begin to
/// look for `begin` among the steps; it is moved on, so that pieces in order cost O(steps) in all.
///
/// With t = x - center, length l, M0 = integral of V, M1 = integral of V t: the line is
/// M0 / l + (12 M1 / l^3) t.
[[nodiscard]] PieceLine least_squares_line(const StepFunction& function, const FitRules& rules,
                                           std::int64_t begin, std::int64_t end, std::size_t& segment);

}  // namespace pdsm
