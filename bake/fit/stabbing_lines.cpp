// SPDX-License-Identifier: Apache-2.0
#include "fit/stabbing_lines.h"

#include <algorithm>

namespace pdsm {

std::int64_t StabbingLines::reach(std::int64_t x, std::int64_t limit, std::int64_t low,
                                  std::int64_t high) const {
  const std::int64_t fall = steepest_.y0 - steepest_.y1, rise = shallowest_.y1 - shallowest_.y0;
  // A falling steepest line meets `low`, a rising shallowest line `high`; at most one of them is in the way.
  if (fall > 0)
    limit = std::min(limit, steepest_.x0 + (steepest_.y0 - low) * (steepest_.x1 - steepest_.x0) / fall);
  if (rise > 0)
    limit =
        std::min(limit, shallowest_.x0 + (high - shallowest_.y0) * (shallowest_.x1 - shallowest_.x0) / rise);
  return std::max(limit, x);
}

}  // namespace pdsm
