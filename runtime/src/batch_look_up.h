// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "pdsm/runtime/look_up.h"
#include "prepared_map.h"

namespace pdsm {

/// attenuation[n] = attenuation at world_points[n], without a footprint: the bits of the look-up of one
/// point. Points go through each step together, so that the processor waits neither for memory nor for
/// branches that it can't foresee.
void look_up_many(const PreparedMap& map, std::span<const std::array<double, 3>> world_points, Filter filter,
                  std::span<float> attenuation);
/// The same of each channel.
void look_up_many(const PreparedMap& map, std::span<const std::array<double, 3>> world_points, Filter filter,
                  std::span<std::array<float, 3>> attenuation);

}  // namespace pdsm
