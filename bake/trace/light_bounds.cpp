// SPDX-License-Identifier: Apache-2.0
#include "trace/light_bounds.h"

#include <algorithm>

namespace pdsm {

LightBounds bound_samples(std::span<const LightSample> samples) {
  // The centre counts as one of them: shadows begin in their casters, whatever side all samples are on.
  LightBounds bounds;
  for (const LightSample& sample : samples) {
    for (std::size_t a = 0; a < 2; ++a) {
      bounds.min[a] = std::min(bounds.min[a], sample.position[a]);
      bounds.max[a] = std::max(bounds.max[a], sample.position[a]);
    }
    bounds.min_z = std::min(bounds.min_z, sample.position[2]);
    bounds.max_z = std::max(bounds.max_z, sample.position[2]);
  }
  return bounds;
}

}  // namespace pdsm
