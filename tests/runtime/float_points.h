// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pdsm/runtime/look_up.h"
#include "random_map.h"

/// Points to hold a shader to the look-up on the CPU, and what the look-up allows there.
namespace pdsm::testing {

/// A point of view space in the world.
[[nodiscard]] std::array<double, 3> to_world(const View& view, const std::array<double, 3>& p);

/// A position as a shader gets it.
using FloatPoint = std::array<float, 3>;

/// Points for a map, in world space: anywhere in and around its windows, at vertices of functions (where they
/// may jump), on the windows' borders, at near and far and beyond.
[[nodiscard]] std::vector<FloatPoint> points_to_try(Random& random, const PenumbraMap& map,
                                                    std::size_t count);

/// Whether a look-up in floats may say `value`: it is within the look-up's least and greatest attenuation
/// over the position +- 4 ulp along each axis (of the largest number that the position meets on its way into
/// the views), widened by one quantum of the map's values, or a float's own rounding where the quantum is
/// finer. With a footprint, also by what a shader's log2 may be off.
[[nodiscard]] bool may_say(float value, const PenumbraMap& map, const PenumbraLookUp& look_up,
                           const FloatPoint& point, Filter filter, double footprint = 0);

}  // namespace pdsm::testing
