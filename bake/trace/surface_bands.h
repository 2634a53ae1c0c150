// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trace/embree_scene.h"
#include "trace/sample_map.h"

namespace pdsm {

/// Depths [first, last] around receiver surfaces, metres.
struct DepthBand {
  float first = 0, last = 0;
};

/// For each texel of `rect` (texels of the map, row by row): where look-ups at the scene's own surfaces ask
/// its function, as bands in order of depth that do not overlap. A bilinear look-up at a point of a surface
/// asks four texels, up to a texel away: so each light-facing receiver surface on the ray of a texel or of
/// one of its eight neighbours gives the band of depths that its plane takes within a texel of that ray,
/// widened by `margin` metres. Any thread.
[[nodiscard]] std::vector<std::vector<DepthBand>> find_surface_bands(const EmbreeScene& scene,
                                                                     const MapGrid& grid,
                                                                     const TexelRect& rect, double margin);

}  // namespace pdsm
