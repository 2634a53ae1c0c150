// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pdsm/bake/bake.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Counts over functions.
struct MapStatistics {
  std::uint64_t texels = 0;
  std::uint64_t empty_texels = 0;  ///< V = 0 everywhere
  std::uint64_t pieces = 0;        ///< that are stored, a vertex each
  std::uint64_t longest = 0;       ///< pieces of the longest function
};

/// Over all functions of a map.
[[nodiscard]] MapStatistics map_statistics(const PenumbraMap& map);

/// Bytes that a map takes in textures, in the two-level layout (runtime/): a word a texel, and the vertices.
/// Functions that are equal take less there; a map with more vertices than a word can number takes more.
[[nodiscard]] std::uint64_t texture_bytes(const BakedMap& baked);

/// Over those of one mip level, of all layers and views.
[[nodiscard]] MapStatistics level_statistics(const PenumbraMap& map, std::uint32_t level);

}  // namespace pdsm
