// SPDX-License-Identifier: Apache-2.0
#include "map_packing.h"

#include <algorithm>

namespace pdsm {

std::array<std::uint32_t, 2> image_size(const ShaderView& view) {
  const auto [width, height, planes, levels] = view.image;
  return {width + (levels > 1 ? width / 2 : 0), height * planes};
}

std::array<std::uint32_t, 2> image_corner(const ShaderView& view, std::uint32_t plane, std::uint32_t level) {
  const auto [width, height, planes, levels] = view.image;
  const std::uint32_t y = plane * height;
  if (level == 0) return {0, y};
  return {width, y + height - (height >> (level - 1))};
}

void refuse_map(std::size_t map, const std::string& reason) {
  throw Error(Failure::resource, "maps[" + std::to_string(map) + "]", reason);
}

Atlas place_images(std::span<const std::array<std::uint32_t, 2>> sizes, std::span<const std::uint32_t> map_of,
                   const TextureLimits& limits) {
  const Atlas atlas = place_rectangles(sizes, limits.texture_size);
  if (atlas.width <= limits.texture_size && atlas.height <= limits.texture_size) return atlas;
  const auto area = [&](std::size_t n) { return std::uint64_t{sizes[n][0]} * sizes[n][1]; };
  std::size_t largest = 0;
  for (std::size_t n = 0; n < sizes.size(); ++n)
    if (area(n) > area(largest)) largest = n;
  refuse_map(map_of[largest], "the set needs a texture of " + std::to_string(atlas.width) + " x " +
                                  std::to_string(atlas.height) + " texels, the limit is " +
                                  std::to_string(limits.texture_size) + "; this map takes most of it, " +
                                  std::to_string(sizes[largest][0]) + " x " +
                                  std::to_string(sizes[largest][1]));
}

}  // namespace pdsm
