// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "walk/map_grid.h"

namespace pdsm {

/// Bounds of the light samples along view x and y (of a distant light, of their directions) and of its
/// centre; and along z, which are 0 by the shift law.
struct LightBounds {
  std::array<double, 2> min{}, max{};
  double min_z = 0, max_z = 0;
};
[[nodiscard]] LightBounds bound_samples(std::span<const LightSample> samples);

}  // namespace pdsm
