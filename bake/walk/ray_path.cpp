// SPDX-License-Identifier: Apache-2.0
#include "walk/ray_path.h"

#include <cmath>

namespace pdsm {
namespace {

/// Grid of the fractions. Texel indices below 2^28 leave sums of them exact in double.
constexpr double kFractionSteps = 0x1.0p24;

double round_fraction(double g) {
  return std::floor(g * kFractionSteps + 0.5) / kFractionSteps;
}

/// g at w = 0 by the shift law: whole texels of the ray's index, exactly, plus a constant
/// of the sample and the ray's phase.
double planar_start(const GridRatio& ratio, std::uint32_t index, double sample_shift) {
  const std::uint32_t phase = index % ratio.coarse;
  const double whole = static_cast<double>(index / ratio.coarse) * ratio.fine;
  const double center = round_fraction((phase + 0.5) * ratio.fine / ratio.coarse);
  return whole + (center + round_fraction(sample_shift));
}

void set_start(RayPath& path, std::size_t axis, double start) {
  const double whole = std::floor(start);
  path.base[axis] = static_cast<std::int64_t>(whole);
  path.fraction[axis] = start - whole;
}

RayPath make_parallel_path(const MapGrid& grid, const LightSample& sample,
                           const std::array<std::uint32_t, 2>& index) {
  RayPath path;
  path.projection = Projection::orthographic;
  path.origin_z = grid.focus_depth;
  path.w_begin = grid.focus_depth - grid.near_depth;
  path.w_end = grid.focus_depth - grid.far_depth;
  for (std::size_t a = 0; a < 2; ++a) {
    set_start(path, a, planar_start(grid.ratio[a], index[a], -static_cast<double>(sample.jitter[a])));
    path.slope[a] = sample.position[a] / grid.pitch[a];
  }
  return path;
}

RayPath make_central_path(const MapGrid& grid, const LightSample& sample,
                          const std::array<std::uint32_t, 2>& index) {
  const double focus = grid.focus_depth, s_z = sample.position[2];
  const double lambda = (focus - s_z) / focus;
  RayPath path;
  path.origin_z = s_z;
  path.w_begin = 1 / (grid.near_depth - s_z);
  path.w_end = 1 / (grid.far_depth - s_z);
  for (std::size_t a = 0; a < 2; ++a) {
    const double s = sample.position[a], pitch = grid.pitch[a];
    const double u = grid.center_slope(static_cast<int>(a), index[a]);
    const double shift = s / focus / pitch - sample.jitter[a];
    set_start(path, a,
              obeys_shift_law(grid, sample) ? planar_start(grid.ratio[a], index[a], shift)
                                            : round_fraction((lambda * u - grid.origin[a]) / pitch + shift));
    path.slope[a] = lambda * (s_z * u - s) / pitch;
  }
  return path;
}

}  // namespace

RayPath make_ray_path(const MapGrid& grid, const LightSample& sample, std::uint32_t i, std::uint32_t j) {
  return grid.perspective() ? make_central_path(grid, sample, {i, j})
                            : make_parallel_path(grid, sample, {i, j});
}

}  // namespace pdsm
