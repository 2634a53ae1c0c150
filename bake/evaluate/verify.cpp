// SPDX-License-Identifier: Apache-2.0
#include "evaluate/verify.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pdsm/runtime/look_up.h"

namespace pdsm {
namespace {

/// Of the channel that is farthest off.
double farthest_error(const LookUpResult& found, const ProbedTruth& truth, std::size_t point) {
  double farthest = 0;
  for (std::size_t channel = 0; channel < found.rgb.size(); ++channel) {
    const double error = static_cast<double>(found.rgb[channel]) - truth.value(point, channel);
    if (std::abs(error) > std::abs(farthest)) farthest = error;
  }
  return farthest;
}

/// Errors at all probes; counts what the look-ups said.
std::vector<double> look_up_errors(const PenumbraMap& map, const ProbedTruth& truth, VerifyResult& result) {
  const PenumbraLookUp look_up(map);
  std::vector<double> errors(truth.points.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const glm::dvec3& p = truth.points[i];
    const LookUpResult found = look_up.at({p.x, p.y, p.z}, Filter::bilinear);
    errors[i] = farthest_error(found, truth, i);
    result.past_end += found.status == PointStatus::past_end ? 1 : 0;
  }
  return errors;
}

/// Sum of |error| over points first .. last - 1, divided by how many of them are in shadow.
double mean_abs_error(const std::vector<double>& errors, const ProbedTruth& truth, std::size_t first,
                      std::size_t last) {
  double sum = 0, shadowed = 0;
  for (std::size_t i = first; i < last; ++i) {
    sum += std::abs(errors[i]);
    shadowed += truth.value(i) > 0 ? 1 : 0;
  }
  return sum / std::max(1.0, shadowed);
}

void summarise(std::vector<double> errors, const ProbedTruth& truth, VerifyResult& result) {
  if (errors.empty()) return;
  double sum_squares = 0, sum = 0, sum_truth = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    sum_squares += errors[i] * errors[i];
    sum += errors[i];
    if (truth.value(i) > 0) sum_truth += truth.squared_error(i);
  }
  const auto shadowed = static_cast<double>(std::max<std::uint64_t>(1, result.shadowed_points));
  result.mean_abs_error = mean_abs_error(errors, truth, 0, errors.size());
  result.surface_error = mean_abs_error(errors, truth, 0, result.surface_points);
  result.free_error = mean_abs_error(errors, truth, result.surface_points, errors.size());
  result.rms_error = std::sqrt(sum_squares / shadowed);
  result.bias = sum / shadowed;
  result.truth_standard_error = std::sqrt(sum_truth / shadowed);

  // The rank counts from the top, in hundredths of the points in shadow.
  std::transform(errors.begin(), errors.end(), errors.begin(), [](double e) { return std::abs(e); });
  std::sort(errors.begin(), errors.end(), std::greater<>());
  result.max_error = errors.front();
  result.p99_error = errors[std::min<std::size_t>(result.shadowed_points / 100, errors.size() - 1)];
}

}  // namespace

VerifyResult verify(const PenumbraMap& map, const Scene& scene, const Light& light,
                    const VerifyOptions& options) {
  return verify(map, probe_truth(map, scene, light, options));
}

VerifyResult verify(const PenumbraMap& map, const ProbedTruth& truth) {
  VerifyResult result;
  result.points = truth.points.size();
  result.surface_points = truth.surface_points;
  result.buried = truth.buried;
  result.shadowed_points = truth.shadowed_points();
  summarise(look_up_errors(map, truth, result), truth, result);
  return result;
}

}  // namespace pdsm
