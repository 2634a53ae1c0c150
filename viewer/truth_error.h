// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "surface_capture.h"

namespace pdsm {

/// map - truth of each captured pixel, of the light where it is largest: as `pdsm render --difference`. NaN
/// where no light with a map shines on the surface, where there is none, or where the truth is not known (<
/// 0).
[[nodiscard]] std::vector<float> truth_error(const CapturedSurfaces& captured,
                                             const std::vector<std::vector<float>>& truth);

/// A picture for showing of one that is known on coarse grids at first (kTruthStrides): a pixel whose
/// `known` (>= 0) is still to come takes the value of the finest coarser one, to the lower left.
[[nodiscard]] std::vector<float> fill_from_coarser(const std::vector<float>& values,
                                                   const std::vector<float>& known, int width, int height);

}  // namespace pdsm
