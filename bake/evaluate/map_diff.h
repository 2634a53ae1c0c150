// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// How the functions of two maps differ. Two piecewise-linear functions differ most at a vertex of either,
/// on one of its two sides: looking there alone is exact.
struct MapDifference {
  /// Why the maps can't be compared, e.g. "windows differ"; empty when they can. Then the rest holds.
  std::string incomparable;
  std::uint32_t width = 0, height = 0;  ///< texels of image 0
  std::uint64_t texels = 0;             ///< of all images
  std::uint64_t differing_texels = 0;   ///< whose functions differ anywhere
  std::uint64_t differing_domains = 0;  ///< whose ends of domain differ, as codes; not a difference of V
  double max_difference = 0;            ///< largest |A - B| over texels and depths
  double mean_difference = 0;           ///< |A - B| averaged over the depths near .. far, then over texels
  std::uint32_t worst_i = 0, worst_j = 0, worst_image = 0, worst_level = 0;  ///< texels of that mip level
  double worst_depth = 0;        ///< metres; where max_difference was seen
  std::vector<float> texel_max;  ///< largest |A - B| of each texel of image 0, row by row from y0
};

/// Compares two maps function by function. They may differ in near, far and coding, but must show the same
/// images of the same frames and windows.
[[nodiscard]] MapDifference compare_maps(const PenumbraMap& a, const PenumbraMap& b);

}  // namespace pdsm
