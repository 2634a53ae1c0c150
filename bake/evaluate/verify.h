// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "evaluate/probed_truth.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// How far a map is from the truth. An error is look-up (bilinear) minus truth, of three
/// channels that which is farthest off. Means are sums over all
/// points divided by the number of points in true shadow, so that false shadow on lit points counts in full
/// and lit points dilute nothing.
struct VerifyResult {
  std::uint64_t points = 0;           ///< that were found and measured
  std::uint64_t surface_points = 0;   ///< of them on surfaces, at which the look-up is done as they are
  std::uint64_t buried = 0;           ///< further points on surfaces, left out: nothing sees them
  std::uint64_t shadowed_points = 0;  ///< with true V > 0
  std::uint64_t past_end = 0;         ///< whose look-up said past_end
  double mean_abs_error = 0;          ///< sum |error| / shadowed_points
  double surface_error = 0;           ///< mean_abs_error of the points on surfaces alone
  double free_error = 0;              ///< mean_abs_error of the points in free space alone
  double rms_error = 0;               ///< sqrt(sum error^2 / shadowed_points)
  double p99_error = 0;               ///< |error| that shadowed_points / 100 of the points exceed
  double max_error = 0;               ///< largest |error|
  double bias = 0;                    ///< sum error / shadowed_points; > 0: too dark
  double truth_standard_error = 0;    ///< rms standard error of the truth at points in shadow
};

/// Measures `map`, of `light`, against shadow rays through `scene`. Uses all threads; the result does not
/// depend on their number.
[[nodiscard]] VerifyResult verify(const PenumbraMap& map, const Scene& scene, const Light& light,
                                  const VerifyOptions& options = {});

/// The same at points of which the truth is known already, from probe_truth() for this map.
[[nodiscard]] VerifyResult verify(const PenumbraMap& map, const ProbedTruth& truth);

}  // namespace pdsm
