// SPDX-License-Identifier: Apache-2.0
#include "evaluate/error_part.h"

#include <algorithm>
#include <cmath>

namespace pdsm {

ErrorPart sum_up(std::span<const double> changes, const ProbedTruth& truth) {
  ErrorPart part;
  for (const double change : changes) {
    part.rms += change * change;
    part.mean_abs += std::abs(change);
    part.bias += change;
  }
  const auto shadowed = static_cast<double>(std::max<std::size_t>(1, truth.shadowed_points()));
  return {std::sqrt(part.rms / shadowed), part.mean_abs / shadowed, part.bias / shadowed};
}

}  // namespace pdsm
