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
  }
  return bounds;
}

}  // namespace pdsm
