// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "truth/lit_surfaces.h"

namespace pdsm {

/// How far behind a caster its shadow begins in a baked map (docs/maths.md, "Bias"), for rays that have to
/// leave out the same shadows as a bake does.
struct CasterBias {
  double constant = 0;      ///< metres
  double limit = 0;         ///< metres: of planes that are seen edge-on within the reach
  double limited_from = 0;  ///< metres: slopes that add no more are free
  /// What other slopes add ends `way_to_next` of the way to the next of these behind the caster, those nearer
  /// than `least_gap` of the depth and `same_surface` of the constant left out. Null: nowhere.
  const LitSurfaces* behind = nullptr;
  double way_to_next = 1, same_surface = 0, least_gap = 0;
  bool parallel = false;  ///< the light is distant
};

/// A point of a light.
struct LightPoint {
  glm::dvec3 position{0};  ///< light space, metres; of a distant light the direction of its rays, z = 1
  /// Within this change of a ray's direction (x/z and y/z; of a distant light: of its place, metres) a texel
  /// of the point's map stands for the plane of what it shows. Only CasterBias asks.
  std::array<double, 2> reach{};
};

/// What the slope of a caster's plane of normal `n` (any length, light space) adds, metres; seen from `from`
/// along direction `d` (d.z = 1) at `depth` metres along z.
[[nodiscard]] inline double slope_bias(const CasterBias& bias, const LightPoint& from, const glm::dvec3& n,
                                       const glm::dvec3& d, double depth) {
  const double shrink = from.reach[0] * std::abs(n.x) + from.reach[1] * std::abs(n.y);
  const double facing = std::abs(glm::dot(n, d));
  const double left = bias.parallel ? facing : facing - shrink,
               slope = bias.parallel ? shrink : depth * shrink;
  return slope < bias.limit * left ? slope / left : bias.limit;
}

}  // namespace pdsm
