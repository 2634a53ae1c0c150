// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "pdsm/format/penumbra_map.h"

/// The texel grids of a bake: the PDSM's, and the sample shadow maps', which all share one grid on the
/// focus plane z = F (two-plane parametrisation), shifted by each sample's jitter. Grids are in slopes as
/// seen from the light's centre, and in metres along x and y under a distant light ("slope" stands for both).
namespace pdsm {

/// Texels of the sample maps against texels of the PDSM along one axis: `fine` map texels a PDSM texel or
/// one map texel over `coarse` PDSM texels; one of the two is 1, so that one list of walk steps serves
/// every ray (of one phase).
struct GridRatio {
  std::uint32_t fine = 1, coarse = 1;

  [[nodiscard]] double maps_per_texel() const { return static_cast<double>(fine) / coarse; }
};

/// The ratio nearest to map_texels / texels.
[[nodiscard]] inline GridRatio round_ratio(std::uint32_t map_texels, std::uint32_t texels) {
  const double ratio = static_cast<double>(map_texels) / texels;
  const auto whole = [](double x) { return static_cast<std::uint32_t>(std::max(1L, std::lround(x))); };
  return ratio >= 1 ? GridRatio{whole(ratio), 1} : GridRatio{1, whole(1 / ratio)};
}

/// Geometry up to this share of near is the emitter itself, or behind it, and never blocks.
inline constexpr double kEmitterShare = 1e-4;

/// The points origin + z direction: a PDSM ray by depth, or a map's by depth behind its sample.
struct CentralRay {
  glm::dvec3 origin{0}, direction{0, 0, 1};
};

struct MapGrid {
  Projection projection = Projection::perspective;
  std::array<double, 2> origin{};  ///< slope at the window's lower corner
  std::array<double, 2> pitch{};   ///< slope per map texel
  std::array<GridRatio, 2> ratio{};
  std::array<std::uint32_t, 2> texels{};  ///< PDSM texels
  double near_depth = 0, far_depth = 0;
  /// F: 1/F = (1/near + 1/far) / 2, orthographic F = (near + far) / 2, halves the margins.
  double focus_depth = 0;
  /// One view of several: samples lie behind its origin too, and all that their rays meet may block.
  bool is_one_of_several = false;

  [[nodiscard]] bool perspective() const { return projection == Projection::perspective; }

  /// Metres at `depth` for a change of slope by 1.
  [[nodiscard]] double spread_at(double depth) const { return perspective() ? depth : 1; }

  /// One sample that stands for the whole light.
  [[nodiscard]] LightSample centre_sample() const {
    LightSample sample;
    sample.position[2] = perspective() ? 0 : 1;
    return sample;
  }

  /// The ray of slope (u, v).
  [[nodiscard]] CentralRay ray(double u, double v) const {
    if (perspective()) return {{0, 0, 0}, {u, v, 1}};
    return {{u, v, 0}, {0, 0, 1}};
  }

  /// Slope of PDSM texel centre `index` along `axis`.
  [[nodiscard]] double center_slope(int axis, std::uint32_t index) const {
    const auto a = static_cast<std::size_t>(axis);
    return origin[a] + (index + 0.5) * pitch[a] * ratio[a].maps_per_texel();
  }
};

[[nodiscard]] inline MapGrid make_map_grid(const View& view, std::uint32_t map_width,
                                           std::uint32_t map_height) {
  MapGrid grid;
  grid.texels = {view.width, view.height};
  grid.ratio = {round_ratio(map_width, view.width), round_ratio(map_height, view.height)};
  grid.near_depth = view.near_depth;
  grid.far_depth = view.far_depth;
  grid.projection = view.projection;
  grid.focus_depth = grid.perspective() ? 2 / (1 / view.near_depth + 1 / view.far_depth)
                                        : (view.near_depth + view.far_depth) / 2;
  for (std::size_t a = 0; a < 2; ++a) {
    grid.origin[a] = view.window[a];
    grid.pitch[a] = (view.window[a + 2] - view.window[a]) / grid.texels[a] / grid.ratio[a].maps_per_texel();
  }
  return grid;
}

}  // namespace pdsm
