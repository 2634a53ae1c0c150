// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "atlas.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/map_textures.h"
#include "planes.h"

/// Flags of ShaderMap and ShaderView, as pdsm.glsl names them.
inline constexpr std::uint32_t kBilinear = 1, kLayersAdd = 2, kColour = 4;
inline constexpr std::uint32_t kOrthographic = 1, kDepth32 = 2;

/// The two layouts: they fill the textures and, in the views' tables, where functions lie. Throw Error
/// (resource) "maps[n]: reason" when a limit would be exceeded.
namespace pdsm {

void pack_two_level(std::span<const PenumbraMap* const> maps, const TextureLimits& limits,
                    MapTextures& textures);
void pack_fixed_depth(std::span<const PenumbraMap* const> maps, const TextureLimits& limits,
                      MapTextures& textures);

/// Room that all planes and levels of a view take, texels: planes one upon the other; beside level 0, level 1
/// and below it the others.
[[nodiscard]] std::array<std::uint32_t, 2> image_size(const ShaderView& view);

/// Corner of one plane and level within that room, as pdsm_filter finds it.
[[nodiscard]] std::array<std::uint32_t, 2> image_corner(const ShaderView& view, std::uint32_t plane,
                                                        std::uint32_t level);

/// Whether the tables of `view` hold this image.
[[nodiscard]] inline bool is_packed(const ShaderView& view, const FunctionImage& image) {
  return image.level < view.image[3];
}

/// An atlas within the limit, or the refusal of the map that needs most.
[[nodiscard]] Atlas place_images(std::span<const std::array<std::uint32_t, 2>> sizes,
                                 std::span<const std::uint32_t> map_of, const TextureLimits& limits);

[[noreturn]] void refuse_map(std::size_t map, const std::string& reason);

}  // namespace pdsm
