// SPDX-License-Identifier: Apache-2.0
#include "evaluate/error_budget.h"

#include <algorithm>
#include <cmath>

#include "evaluate/point_parts.h"

namespace pdsm {

ErrorBudget measure_error_budget(const PenumbraMap& map, const Scene& scene, const Light& light,
                                 const BakeOptions& options, const ProbedTruth& truth) {
  const PointParts parts = measure_point_parts(map, scene, light, options, truth);
  ErrorBudget budget;
  budget.sampling = sum_up(parts.sampling, truth);
  budget.filter = sum_up(parts.filter, truth);
  budget.map = sum_up(parts.map, truth);
  budget.fit = sum_up(parts.fit, truth);
  budget.quantisation = sum_up(parts.quantisation, truth);
  budget.total = sum_up(parts.total, truth);
  budget.depth_bias = sum_up(parts.depth_bias, truth);
  for (std::size_t n = 0; n < parts.total.size(); ++n)
    budget.telescoping_fault = std::max(budget.telescoping_fault, std::abs(parts.sum(n) - parts.total[n]));
  double squares = 0;
  for (const ErrorPart* part :
       {&budget.sampling, &budget.filter, &budget.map, &budget.fit, &budget.quantisation})
    squares += part->rms * part->rms;
  budget.root_sum_squares = std::sqrt(squares);
  return budget;
}

ErrorBudget measure_error_budget(const PenumbraMap& map, const Scene& scene, const Light& light,
                                 const BakeOptions& options, const VerifyOptions& verify_options) {
  return measure_error_budget(map, scene, light, options, probe_truth(map, scene, light, verify_options));
}

}  // namespace pdsm
