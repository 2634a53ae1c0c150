// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tile/sample_bias.h"
#include "trace/embree_scene.h"
#include "walk/map_grid.h"

namespace pdsm {

/// Which slopes have to be kept before the next receiver (docs/maths.md, "Bias").
struct SlopeLimit {
  double from = 0;         ///< metres, for DepthBias
  bool thin_gaps = false;  ///< whether receivers lie so close behind others that gentle slopes matter
};

/// Asks a grid of rays from the light's centre. Rays are traced twice for a limit, so gentle slopes go free
/// where hardly any would be changed. `constant`: of the bias, metres. Uses one thread.
[[nodiscard]] SlopeLimit find_slope_limit(const EmbreeScene& scene, const MapGrid& grid, Walk walk,
                                          double constant);

}  // namespace pdsm
