// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/map_textures.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>

#include "map_packing.h"
#include "vertex_forms.h"

namespace pdsm {
namespace {

/// The greatest float that is no greater than `code`.
float float_below(std::uint32_t code) {
  const auto nearest = static_cast<float>(code);
  return static_cast<double>(nearest) > code ? std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) - 1)
                                             : nearest;
}

/// Row `row` of p -> R (p + origin) + t. The sum is made in double: far from 0, t and R origin cancel.
std::array<double, 4> motion_row(const RigidTransform& motion, std::size_t row,
                                 const std::array<double, 3>& origin) {
  const double* r = motion.rotation.data() + 3 * row;
  return {r[0], r[1], r[2], r[0] * origin[0] + r[1] * origin[1] + r[2] * origin[2] + motion.translation[row]};
}

/// u * reach = (x - x0 * reach) * texels / width for each axis, and depth: as few roundings as can be are
/// left to the shader.
std::array<std::array<float, 4>, 3> texel_rows(const View& view, const std::array<double, 3>& origin) {
  const std::array<double, 4> depth = motion_row(view.world_to_view, 2, origin);
  const bool orthographic = view.projection == Projection::orthographic;
  const std::array<double, 4> reach = orthographic ? std::array<double, 4>{0, 0, 0, 1} : depth;
  const std::array<double, 2> texels{static_cast<double>(view.width), static_cast<double>(view.height)};
  std::array<std::array<float, 4>, 3> rows{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double low = view.window[axis], scale = texels[axis] / (view.window[axis + 2] - low);
    const std::array<double, 4> lateral = motion_row(view.world_to_view, axis, origin);
    for (std::size_t n = 0; n < 4; ++n)
      rows[axis][n] = static_cast<float>((lateral[n] - low * reach[n]) * scale);
  }
  for (std::size_t n = 0; n < 4; ++n) rows[2][n] = static_cast<float>(depth[n]);
  return rows;
}

/// All of a view's table but where its functions lie.
ShaderView describe_view(const PenumbraMap& map, std::uint32_t index, const std::array<double, 3>& origin) {
  const View& view = map.views[index];
  ShaderView table;
  table.rows = texel_rows(view, origin);
  const double scale = std::max(view.width / (view.window[2] - view.window[0]),
                                view.height / (view.window[3] - view.window[1]));
  table.scale = {static_cast<float>(map.coding.value_max), static_cast<float>(scale), 0, 0};
  table.depth = {static_cast<float>(view.near_depth),
                 static_cast<float>(map.coding.depth_max() / (view.far_depth - view.near_depth)),
                 float_below(map.coding.depth_max()), 0};
  table.image = {view.width, view.height, plane_count(map), level_count(map, index)};
  table.flags = (view.projection == Projection::orthographic ? kOrthographic : 0) |
                (map.coding.depth_bits == 32 ? kDepth32 : 0);
  table.form = vertex_form(map.coding);
  return table;
}

/// Maps and views in order, with room for all.
void fill_tables(std::span<const PenumbraMap* const> maps, const std::array<double, 3>& origin,
                 ShaderTables& tables) {
  std::uint32_t views = 0;
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const PenumbraMap& map = *maps[n];
    if (n >= kMaxShaderMaps) refuse_map(n, "a set holds at most " + std::to_string(kMaxShaderMaps) + " maps");
    if (views + map.views.size() > kMaxShaderViews)
      refuse_map(n, "a set holds at most " + std::to_string(kMaxShaderViews) + " views");
    ShaderMap& entry = tables.maps[n];
    entry.first_view = views;
    entry.view_count = static_cast<std::uint32_t>(map.views.size());
    entry.flags =
        (map.layer_rule == LayerRule::clamped_sum ? kLayersAdd : 0) | (map.channels == 3 ? kColour : 0);
    for (std::uint32_t v = 0; v < map.views.size(); ++v)
      tables.views[views++] = describe_view(map, v, origin);
    set_look_up(tables, static_cast<std::uint32_t>(n), LookUpSettings{});
  }
}

}  // namespace

MapTextures make_map_textures(std::span<const PenumbraMap* const> maps, TextureLayout layout,
                              const TextureLimits& limits, const std::array<double, 3>& origin) {
  MapTextures textures;
  textures.layout = layout;
  textures.map_count = static_cast<std::uint32_t>(maps.size());
  fill_tables(maps, origin, textures.tables);
  if (layout == TextureLayout::two_level)
    pack_two_level(maps, limits, textures);
  else
    pack_fixed_depth(maps, limits, textures);
  return textures;
}

void set_look_up(ShaderTables& tables, std::uint32_t map, const LookUpSettings& settings) {
  assert(map < kMaxShaderMaps);
  ShaderMap& entry = tables.maps[map];
  entry.flags = (entry.flags & ~kBilinear) | (settings.filter == Filter::bilinear ? kBilinear : 0);
  entry.normal_offset = settings.normal_offset;
}

}  // namespace pdsm
