// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tile/sample_bias.h"
#include "trace/embree_scene.h"
#include "walk/map_grid.h"

namespace pdsm {

/// Which slopes have to be kept before the next receiver (docs/maths.md, "Bias").
struct SlopeLimit {
  double from = 0;  ///< metres, for DepthBias; infinity where all slopes may go free
};

/// Asks a grid of rays from the light's centre. Rays are traced twice for a limit, so slopes go free below
/// the least that would let more than one ray in a thousand leak. `constant`: of the bias, metres. The answer
/// is the same for any number of threads.
[[nodiscard]] SlopeLimit find_slope_limit(const EmbreeScene& scene, const MapGrid& grid, Walk walk,
                                          double constant, std::uint32_t threads);

}  // namespace pdsm
