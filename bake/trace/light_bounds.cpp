// SPDX-License-Identifier: Apache-2.0
#include "trace/light_bounds.h"

#include <algorithm>

namespace pdsm {

LightBounds bound_samples(std::span<const LightSample> samples) {
  LightBounds bounds{samples[0].position[0], samples[0].position[1], samples[0].position[0],
                     samples[0].position[1]};
  for (const LightSample& sample : samples) {
    for (std::size_t a = 0; a < 2; ++a) {
      bounds.min[a] = std::min(bounds.min[a], sample.position[a]);
      bounds.max[a] = std::max(bounds.max[a], sample.position[a]);
    }
  }
  return bounds;
}

}  // namespace pdsm
