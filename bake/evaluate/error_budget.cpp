// SPDX-License-Identifier: Apache-2.0
#include "evaluate/error_budget.h"

#include <algorithm>
#include <cmath>

#include "evaluate/point_parts.h"

namespace pdsm {
namespace {

/// Sums changes up to what is told of a cause.
ErrorPart sum_up(const std::vector<double>& changes, double shadowed) {
  ErrorPart part;
  for (const double change : changes) {
    part.rms += change * change;
    part.mean_abs += std::abs(change);
    part.bias += change;
  }
  return {std::sqrt(part.rms / shadowed), part.mean_abs / shadowed, part.bias / shadowed};
}

}  // namespace

ErrorBudget measure_error_budget(const PenumbraMap& map, const Scene& scene, const Light& light,
                                 const BakeOptions& options, const ProbedTruth& truth) {
  const PointParts parts = measure_point_parts(map, scene, light, options, truth);
  const auto shadowed = static_cast<double>(std::max<std::size_t>(1, truth.shadowed_points()));
  ErrorBudget budget;
  budget.sampling = sum_up(parts.sampling, shadowed);
  budget.filter = sum_up(parts.filter, shadowed);
  budget.map = sum_up(parts.map, shadowed);
  budget.fit = sum_up(parts.fit, shadowed);
  budget.quantisation = sum_up(parts.quantisation, shadowed);
  budget.total = sum_up(parts.total, shadowed);
  budget.depth_bias = sum_up(parts.depth_bias, shadowed);
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
