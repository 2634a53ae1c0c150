// SPDX-License-Identifier: Apache-2.0
#include "choose/best_bake.h"

#include "choose/verdict.h"

namespace pdsm {

bool fits_size(const Goals& goals, const Trial& trial) {
  return !goals.size_budget || trial.bytes + kMetadataBytes <= *goals.size_budget;
}

bool BestBake::wants(const Goals& goals, const Trial& trial) const {
  if (!fits_size(goals, trial)) return false;
  if (!goals.target_error) return !best_ || trial.mean_abs_error() < best_->chosen.mean_abs_error();
  // What others may measure to be above the target has not reached it; what went too far is the worse of two.
  const Verdict verdict = judge(*goals.target_error, trial);
  if (verdict == Verdict::too_high) return false;
  return !best_ ||
         (verdict == Verdict::reached && judge(*goals.target_error, best_->chosen) == Verdict::too_good);
}

}  // namespace pdsm
