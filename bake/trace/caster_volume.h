// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

#include "trace/light_bounds.h"
#include "walk/map_grid.h"

/// Where casters must be to be seen in the map of any sample, and what is cut off those that reach far beside
/// it: floats hold no place that is far.
///
/// A point at (G, k) (caster_triangles.h) is seen at G + s k / pitch in the map of sample s. So it is in no
/// map if, along one axis, G + c(k) lies before all maps' lower border, c(k) = max over s of s k / pitch;
/// likewise for the upper one. c is convex, and so not greater than its chord over all k between the first
/// depth and infinity: the chord in its place makes a half-space, for G z and k z are linear in x, y and z.
/// It is at most twice as far from the borders as c is.
namespace pdsm {

struct CasterPolygon {
  /// A triangle after five cuts.
  std::array<glm::dvec3, 8> corners{};
  int count = 0;
};

class CasterVolume {
 public:
  /// Texels beside all maps from which on triangles are cut off. Far enough for most to stay whole.
  static constexpr double kGuardTexels = 0x1p11;

  /// Casters count from `first_depth` > 0 on.
  CasterVolume(const MapGrid& grid, const LightBounds& light, double first_depth);

  /// Whether a triangle lies within all maps' reach: the quick answer for most.
  [[nodiscard]] bool holds(const std::array<glm::dvec3, 3>& triangle) const {
    double least = std::min({triangle[0].z, triangle[1].z, triangle[2].z}) - first_depth_;
    for (const Side& side : sides_)
      for (const glm::dvec3& p : triangle) least = std::min(least, side.distance(p));
    return least >= 0;
  }
  /// What is left of a triangle; none where it misses all maps. A triangle that is not cut, or held,
  /// keeps its corners.
  /// Edges are cut at the same points for both triangles that share them.
  [[nodiscard]] CasterPolygon clip(const std::array<glm::dvec3, 3>& triangle) const;

 private:
  /// Points with normal . P >= offset are inside.
  struct Side {
    glm::dvec3 normal{};
    double offset = 0;

    [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
  };

  [[nodiscard]] bool misses_maps(const CasterPolygon& polygon) const;

  std::array<Side, 4> sides_;
  double first_depth_;
};

}  // namespace pdsm
