// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "walk/map_grid.h"

namespace pdsm {

/// Bounds of the light samples in the light's plane (of a distant light, of their directions) and of its
/// centre.
struct LightBounds {
  std::array<double, 2> min{}, max{};
};
[[nodiscard]] LightBounds bound_samples(std::span<const LightSample> samples);

}  // namespace pdsm
