// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Where the unit square goes on a light, in light space: a point of its plane (metres; of a sphere, of its
/// great disk; of a mesh, of its surface), or the direction of a distant light's rays, z = 1. Equal areas
/// stay equal, for the distant light as solid angles. Rect: scaled. Disk: the concentric map, which keeps
/// strata compact. Distant: that map lifted to the sphere. Paper: Shirley, Chiu, "A Low Distortion Map
/// Between Disk and Square", 1997.
[[nodiscard]] glm::dvec3 light_point(const Light& light, const std::array<double, 2>& unit);

/// Where the unit square goes on what `from` (light space, outside of the sphere) sees of a sphere light
/// about the origin: the cap within the cone of its tangents, equal areas as equal solid angles.
[[nodiscard]] glm::dvec3 visible_cap_point(double radius, const glm::dvec3& from,
                                           const std::array<double, 2>& unit);

/// A point of the baker's model of a sphere light, for four numbers of [0, 1): in the unit ball, with density
/// 1 / sqrt(1 - rho^2). The direction of four normal numbers is uniform; three of its coordinates are taken.
[[nodiscard]] glm::dvec3 model_ball_point(const std::array<double, 2>& unit,
                                          const std::array<double, 2>& more);

/// The same for a light with a picture: equal areas of the square go to parts that emit the same. By columns
/// first, then along the column. What goes beside a disk, whose picture covers its bounding square, is drawn
/// anew.
class LightSurface {
 public:
  explicit LightSurface(const Light& light);

  [[nodiscard]] glm::dvec3 point(const std::array<double, 2>& unit) const;

 private:
  /// Where the unit square goes on the picture's unit square.
  [[nodiscard]] std::array<double, 2> on_picture(const std::array<double, 2>& unit) const;

  Light light_;
  std::vector<double> share_before_;  ///< of columns, then of each column's texels; none without a picture
};

/// A stratified jittered set of any size in the unit square. The square is cut into about sqrt(count) rows
/// and each row into cells, so that every cell has area 1/count; a row with one cell more is that much
/// taller. A square number gives the plain n x n grid.
class JitteredGrid {
 public:
  explicit JitteredGrid(std::uint32_t count);

  /// Point `index`, 0 .. count - 1, row by row.
  [[nodiscard]] std::array<double, 2> point(std::uint32_t index, std::uint64_t seed) const;

 private:
  std::uint32_t count_, rows_, shorter_, longer_rows_;
};

}  // namespace pdsm
