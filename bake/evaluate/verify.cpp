// SPDX-License-Identifier: Apache-2.0
#include "evaluate/verify.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "evaluate/probe_points.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/look_up.h"
#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

// Each use of randomness has its own stream of the seed.
enum Stream : std::uint64_t { kSurface, kFree, kTruthA, kTruthB };

/// The truth in two independent halves: their mean is the truth, their difference tells its error.
struct Truth {
  std::vector<double> a, b;
  [[nodiscard]] double value(std::size_t i) const { return 0.5 * (a[i] + b[i]); }
  [[nodiscard]] double squared_error(std::size_t i) const { return 0.25 * (a[i] - b[i]) * (a[i] - b[i]); }
};

Truth trace_truth(const Scene& scene, const Light& light, double near_depth,
                  const std::vector<glm::dvec3>& probes, const VerifyOptions& options) {
  const ShadowRays rays(scene, light, near_depth);
  const std::uint32_t half = std::max(1U, options.samples / 2);
  return {rays.attenuations(probes, half, hash_bits(options.seed, kTruthA)),
          rays.attenuations(probes, half, hash_bits(options.seed, kTruthB))};
}

/// Errors at all probes; counts what the look-ups said.
std::vector<double> look_up_errors(const PenumbraMap& map, const std::vector<glm::dvec3>& probes,
                                   const Truth& truth, VerifyResult& result) {
  const PenumbraLookUp look_up(map);
  std::vector<double> errors(probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const LookUpResult found = look_up.at({probes[i].x, probes[i].y, probes[i].z}, Filter::bilinear);
    errors[i] = static_cast<double>(found.attenuation) - truth.value(i);
    result.past_end += found.status == PointStatus::past_end ? 1 : 0;
    result.shadowed_points += truth.value(i) > 0 ? 1 : 0;
  }
  return errors;
}

/// Sum of |error| over points first .. last - 1, divided by how many of them are in shadow.
double mean_abs_error(const std::vector<double>& errors, const Truth& truth, std::size_t first,
                      std::size_t last) {
  double sum = 0, shadowed = 0;
  for (std::size_t i = first; i < last; ++i) {
    sum += std::abs(errors[i]);
    shadowed += truth.value(i) > 0 ? 1 : 0;
  }
  return sum / std::max(1.0, shadowed);
}

void summarise(std::vector<double> errors, const Truth& truth, VerifyResult& result) {
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
  if (map.views.size() != 1) throw Error(Failure::input, "views", "only maps of one view can be verified");
  const std::uint32_t on_surfaces = options.free_space ? (options.points + 1) / 2 : options.points;
  std::vector<glm::dvec3> probes =
      surface_probes(scene, map.views.front(), on_surfaces, hash_bits(options.seed, kSurface));
  VerifyResult result;
  result.surface_points = probes.size();
  const std::vector<glm::dvec3> in_air =
      free_probes(map, options.points - on_surfaces, hash_bits(options.seed, kFree));
  probes.insert(probes.end(), in_air.begin(), in_air.end());
  result.points = probes.size();

  const Truth truth = trace_truth(scene, light, map.views.front().near_depth, probes, options);
  summarise(look_up_errors(map, probes, truth, result), truth, result);
  return result;
}

}  // namespace pdsm
