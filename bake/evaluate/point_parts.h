// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "evaluate/probed_truth.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// What each cause of error changes at each point (docs/maths.md, "Error budget"), in the order in which they
/// are let in, and what all change together: look-up - truth.
struct PointParts {
  std::vector<double> sampling, filter, map, fit, quantisation, total;
  std::vector<double> depth_bias;  ///< within `filter`: the bias against self-shadowing at the point itself

  [[nodiscard]] double sum(std::size_t n) const {
    return sampling[n] + filter[n] + map[n] + fit[n] + quantisation[n];
  }
};

/// Measures them for `map`, which bake(scene, light, options) made. Faults and costs: measure_error_budget().
[[nodiscard]] PointParts measure_point_parts(const PenumbraMap& map, const Scene& scene, const Light& light,
                                             const BakeOptions& options, const ProbedTruth& truth);

}  // namespace pdsm
