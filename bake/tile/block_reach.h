// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "trace/light_bounds.h"
#include "walk/map_grid.h"

namespace pdsm {

/// Blocks of a map, half-open; none where one side is.
struct BlockRange {
  std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
  [[nodiscard]] std::uint64_t count() const { return empty() ? 0 : std::uint64_t{x1 - x0} * (y1 - y0); }
};

/// Which blocks have rays that a caster may darken, from anywhere on the light, up to far: no other block
/// changes with it. As tile/shadow_cells.h, without regard to where domains end, so that it follows from the
/// caster alone.
///
/// A point Q at depth t darkens rays z (u, v, 1) for z > t at
///   u in  Q_xy / t - [s_min, s_max] (1/t - 1/z),   z in (t, far]
/// linear fractions of Q for each s and z, so that the bounds of a triangle are those of its corners. Texels
/// that a walk looks at are off by up to kTexelReach.
class BlockReach {
 public:
  /// Map texels. Walks look at texels whose centres are up to one texel off their ray (a midpoint walk half a
  /// texel along both axes); what projection rounds is 1/16 of a texel at most (trace/caster_parts.cpp), and
  /// what paths round is less.
  static constexpr double kTexelReach = 2;

  /// For a perspective grid. Casters count from `first_depth` > 0 on.
  BlockReach(const MapGrid& grid, const LightBounds& light, double first_depth);

  [[nodiscard]] BlockRange of(const std::array<glm::dvec3, 3>& triangle) const;
  /// Of all triangles with corners from `low` to `high`, or of more: everything where the box reaches before
  /// the first depth or behind far.
  [[nodiscard]] BlockRange of_box(const glm::dvec3& low, const glm::dvec3& high) const;

 private:
  /// Bounds as slopes, x and y.
  struct Bounds {
    std::array<double, 2> least, greatest;
    Bounds();
  };
  void include(const glm::dvec3& corner, Bounds& bounds) const;
  [[nodiscard]] BlockRange blocks_of(const Bounds& bounds) const;

  LightBounds light_;
  double first_depth_, inverse_far_;
  std::array<double, 2> origin_, pad_, blocks_per_slope_;
  std::array<std::uint32_t, 2> blocks_;
};

}  // namespace pdsm
