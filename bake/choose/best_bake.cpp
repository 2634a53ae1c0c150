// SPDX-License-Identifier: Apache-2.0
#include "choose/best_bake.h"

#include "choose/verdict.h"

namespace pdsm {
namespace {

/// Lower is better. What reached its target for certain comes first, then what went too far, then what others
/// may measure to be above it.
int rank(Verdict verdict) {
  return verdict == Verdict::reached ? 0 : verdict == Verdict::too_good ? 1 : 2;
}

}  // namespace

bool fits_size(const Goals& goals, const Trial& trial) {
  return !goals.size_budget || trial.bytes + kMetadataBytes <= *goals.size_budget;
}

bool BestBake::wants(const Goals& goals, const Trial& trial) const {
  if (!fits_size(goals, trial)) return false;
  if (!goals.target_error) return !best_ || trial.mean_abs_error() < best_->chosen.mean_abs_error();
  const double target = *goals.target_error;
  if (trial.mean_abs_error() > target) return false;
  return !best_ || rank(judge(target, trial)) < rank(judge(target, best_->chosen));
}

}  // namespace pdsm
