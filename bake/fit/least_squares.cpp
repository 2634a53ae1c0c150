// SPDX-License-Identifier: Apache-2.0
#include "fit/least_squares.h"

#include <algorithm>
#include <limits>

namespace pdsm {

PieceLine least_squares_line(const StepFunction& function, const FitRules& rules, std::int64_t begin,
                             std::int64_t end, std::size_t& segment) {
  const std::size_t steps = function.depth.size();
  // Segment k lies between steps k - 1 and k.
  const auto segment_end = [&](std::size_t k) {
    return k < steps ? rules.code_of(function.depth[k]) : std::numeric_limits<double>::infinity();
  };
  const auto x0 = static_cast<double>(begin), x1 = static_cast<double>(end), center = (x0 + x1) / 2;
  while (segment_end(segment) <= x0) ++segment;
  double moment0 = 0, moment1 = 0, from = x0;
  for (std::size_t k = segment; from < x1; ++k) {
    const double to = std::min(segment_end(k), x1);
    const double count = k == 0 ? 0 : function.count[k - 1];
    moment0 += count * (to - from);
    moment1 += count * (to - from) * ((to + from) / 2 - center);
    from = std::max(from, to);
  }
  const double unit = static_cast<double>(kValueScale) * rules.value_codes / rules.sample_count;
  const double length = x1 - x0, mean = unit * moment0 / length;
  const double half_rise = unit * 6 * moment1 / (length * length);
  return {mean - half_rise, mean + half_rise};
}

}  // namespace pdsm
