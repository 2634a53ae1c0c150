// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pdsm/format/penumbra_map.h"
#include "walk/map_grid.h"

/// The path of one PDSM ray through the map of one light sample: the law that all three walks share.
///
/// The ray of slope u = (u_x, u_y) has the points P(z) = (z u, z). A light sample at s = (s_xy, s_z) sees
/// P through the point where the line from s to P meets the focus plane z = F. As a slope, that is
///
///   a(z) = [ s_xy + (z u - s_xy) (F - s_z) / (z - s_z) ] / F
///
/// and with w = 1 / (z - s_z) and lambda = (F - s_z) / F
///
///   a(w) = lambda u + s_xy / F  +  w lambda (s_z u - s_xy)
///
/// a straight line in w. For s_z = 0 it is the shift law a = u + s (1/F - 1/z): the same path for every
/// ray, translated.
///
/// Under a distant light, rays are parallel, P(z) = (u, z) with u in metres, and a sample is the direction
/// (d, 1) of its light. It sees P through the point a(z) = u + d (F - z) of the focus plane, so that with
/// w = F - z
///
///   a(w) = u  +  w d
///
/// the shift law again. In both, w falls as z grows. In map texels, g = (a - origin) / pitch - jitter. Texel
/// X holds g in [X, X + 1).
///
/// To make the shift exact in floating point, g(w = 0) is rounded to multiples of 2^-24 texel and split
/// into whole texels and a fraction; everything after that depends on the fraction alone.
namespace pdsm {

struct RayPath {
  std::array<std::int64_t, 2> base{};  ///< whole texels of g at w = 0
  std::array<double, 2> fraction{};    ///< rest, multiple of 2^-24 in [0, 1)
  std::array<double, 2> slope{};       ///< texels per w
  double origin_z = 0;                 ///< s_z; orthographic: F
  double w_begin = 0, w_end = 0;       ///< at near and at far; w_begin > w_end
  Projection projection = Projection::perspective;

  /// Depth at w, rounded once.
  [[nodiscard]] float depth(double w) const {
    return static_cast<float>(projection == Projection::perspective ? origin_z + 1 / w : origin_z - w);
  }
};

/// Path of PDSM ray (i, j). `sample.position` is in view space with z < near; orthographic: (d, 1).
[[nodiscard]] RayPath make_ray_path(const MapGrid& grid, const LightSample& sample, std::uint32_t i,
                                    std::uint32_t j);

/// Whether the shift law holds for this sample: it lies in the light's plane, or is a direction.
[[nodiscard]] inline bool obeys_shift_law(const MapGrid& grid, const LightSample& sample) {
  return !grid.perspective() || sample.position[2] == 0;
}

}  // namespace pdsm
