// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "light/convex_clip.h"
#include "pdsm/format/penumbra_map.h"
#include "trace/caster_triangles.h"
#include "trace/light_bounds.h"
#include "trace/light_space.h"
#include "trace/sample_map.h"
#include "walk/map_grid.h"

/// Which rays of a tile some caster can darken at all. The others have empty functions: they are not
/// walked, and what only they would have looked at is not traced.
///
/// A caster point Q at depth t is in the way between the light sample s and the point z (u, v, 1) if
/// Q_xy / t - u = s (1/t - 1/z) for some z in (t, e], e the ray's domain end. So Q can darken rays with
///   u in  Q_xy / t - [s_min, s_max] (1/t - 1/e)
/// widened by what a map texel spans. Under a distant light, of directions (d, 1), these are the rays at
///   u in  Q_xy + [d_min, d_max] (e - t)
/// A triangle's bounds follow from its vertices. Of samples out of the plane, P = Q + m (Q - s) has the slope
///   u = (Q_xy + m (Q_xy - s_xy)) / (t + m (t - s_z)),  m >= 0
/// which is monotone in m and linear fractional in Q, s_xy and s_z: over a triangle behind all samples its
/// bounds are those of its corners at m = 0 and at far, seen from the corners of the samples' box. What of a
/// triangle in the hull of light and window lies beside or before a sample may darken anything. Besides, a
/// triangle can't darken a ray that ends before its plane is crossed, if the whole light is on that side too.
namespace pdsm {

/// Edge of a cell in texels: a divisor of kBlockSize.
inline constexpr std::int32_t kCellSize = 16;

/// The cells of a tile, row by row; 1 where a caster may darken a ray.
struct ShadowCells {
  TexelRect tile;
  std::int32_t across = 0, up = 0;
  std::vector<std::uint8_t> dark;
  std::vector<std::uint32_t> idle_casters;  ///< slots of large casters that can darken none of them, in order

  [[nodiscard]] TexelRect cell_rect(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] bool may_darken(std::int32_t x, std::int32_t y) const {
    return dark[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
                static_cast<std::size_t>(x)] != 0;
  }
  /// Texels of all cells in `rect`, whole blocks, that no caster may darken.
  [[nodiscard]] std::uint64_t undarkened_texels(const TexelRect& rect) const;
};

/// Everything that decides about a tile's cells. The verdict on a cell depends on the cell's own rays and
/// the casters alone, not on the tile.
struct ShadowCellInput {
  const LightSpaceScene& scene;
  const MapGrid& grid;
  LightBounds light;
  double clip_depth = 0;      ///< casters before this depth are out of the hull of light and window
  double depth_rounding = 0;  ///< metres: what a domain end may be off its surface
  const CasterTriangles& casters;
  std::uint32_t threads = 1;
  const ConvexRegion* light_hull =
      nullptr;  ///< where samples lie out of the plane; null: the shift law holds
};

/// Domain end of a texel of the map.
using DomainEndAt = std::function<float(std::int32_t i, std::int32_t j)>;

[[nodiscard]] ShadowCells find_shadow_cells(const ShadowCellInput& input, const TexelRect& tile,
                                            const DomainEndAt& domain_end);

}  // namespace pdsm
