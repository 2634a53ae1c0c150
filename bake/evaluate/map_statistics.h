// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Counts over functions.
struct MapStatistics {
  std::uint64_t texels = 0;
  std::uint64_t empty_texels = 0;  ///< V = 0 everywhere
  std::uint64_t vertices = 0;
  std::uint64_t pieces = 0;   ///< linear pieces between vertices: one less than a function's vertices
  std::uint64_t longest = 0;  ///< vertices of the longest function
};

/// Over all functions of a map.
[[nodiscard]] MapStatistics map_statistics(const PenumbraMap& map);

/// Over those of one mip level, of all layers and views.
[[nodiscard]] MapStatistics level_statistics(const PenumbraMap& map, std::uint32_t level);

}  // namespace pdsm
