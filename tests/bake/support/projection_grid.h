// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trace/light_bounds.h"
#include "walk/map_grid.h"

/// A square window under a light of 1 x 1 m, for tests of what is projected into its maps.
namespace pdsm::test {

inline constexpr double kNear = 2, kFar = 6;
inline constexpr LightBounds kLight{{-0.5, -0.5}, {0.5, 0.5}};

/// Maps as fine as the window's texels x texels.
inline MapGrid make_grid(std::int32_t texels) {
  View view;
  view.window = {-0.5, -0.5, 0.5, 0.5};
  view.width = view.height = static_cast<std::uint32_t>(texels);
  view.near_depth = kNear;
  view.far_depth = kFar;
  return make_map_grid(view, view.width, view.height);
}

}  // namespace pdsm::test
