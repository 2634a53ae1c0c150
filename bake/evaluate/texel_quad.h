// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// The four texels that a bilinear look-up asks (docs/runtime.md), and their shares: corners (low, low),
/// (high, low), (low, high), (high, high). Edges clamp: then a corner may be there twice.
struct TexelQuad {
  std::array<std::array<std::uint32_t, 2>, 4> texel{};
  std::array<double, 2> share{};  ///< of the high ones along x and y
  double depth = 0;               ///< of the point, metres, view space

  /// The corners' values, weighted.
  [[nodiscard]] double mix(const std::array<double, 4>& value) const {
    const double low = value[0] + (value[1] - value[0]) * share[0];
    const double high = value[2] + (value[3] - value[2]) * share[0];
    return low + (high - low) * share[1];
  }
};

/// The quad of a point in the view's window.
[[nodiscard]] TexelQuad quad_at(const View& view, const glm::dvec3& world_point);

/// The world point at `depth` on a texel's central ray.
[[nodiscard]] glm::dvec3 point_on_ray(const View& view, const std::array<std::uint32_t, 2>& texel,
                                      double depth);

}  // namespace pdsm
