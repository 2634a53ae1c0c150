// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pdsm/bake/bake.h"
#include "walk/ray_path.h"

namespace pdsm {

/// One texel of a walk, relative to the path's base texel, and the depths [begin, end) of the ray in it.
struct WalkStep {
  std::int32_t dx = 0, dy = 0;
  float begin = 0, end = 0;

  friend bool operator==(const WalkStep&, const WalkStep&) = default;
};

/// The texels of a path from near to far, in order of depth; begin < end for each, the first begins at
/// near, the last ends at far, each ends where the next begins. A texel that the path crosses within one
/// float of depth is left out. Where the path crosses a column and a row at the same w, it steps both.
///   exact     every texel that the path crosses
///   midpoint  one texel for each column (row, if the path is steeper than 45 degrees): that whose centre
///             is nearest to the path in the middle of the column (Foley et al., Computer Graphics, 1990)
/// Replaces the contents of `steps`.
void list_walk_steps(const RayPath& path, Walk walk, std::vector<WalkStep>& steps);

}  // namespace pdsm
