// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// A vertex of an attenuation function in metres and shares of the light.
struct ProbeVertex {
  double depth = 0, begin = 0, end = 0;
};

/// The attenuation function of the texel that holds a point, with the point's own depth on it.
struct FunctionProbe {
  std::uint32_t view = 0;
  std::array<std::uint32_t, 2> texel{};
  std::vector<std::vector<ProbeVertex>> layers;  ///< the functions, one a layer
  bool layers_add = false;
  double near_depth = 0, far_depth = 1;  ///< metres
  double domain_end = 1;                 ///< metres; up to here the function is exact
  double point_depth = 0;                ///< metres
  RigidTransform world_to_view;
  /// The texel's ray in view space: z slope + offset.
  glm::dvec3 slope{0, 0, 1}, offset{0};
};

/// The function of the texel of level 0 that holds `point` (world, metres), in the first view whose window
/// does; nothing when none does.
[[nodiscard]] std::optional<FunctionProbe> probe_function(const PenumbraMap& map, const glm::dvec3& point);

/// V of the probed texel at a depth, layers combined.
[[nodiscard]] double probe_value(const FunctionProbe& probe, double depth);

}  // namespace pdsm
