// SPDX-License-Identifier: Apache-2.0
#include "scene/glass_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/picture.h"
#include "scene/srgb.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kColourAndAlpha = 4;

/// Linear, in units of 1/255, of each sRGB value.
std::array<std::uint8_t, 256> make_linear_table() {
  std::array<std::uint8_t, 256> table{};
  for (std::size_t n = 0; n < table.size(); ++n)
    table[n] = static_cast<std::uint8_t>(std::lround(255 * srgb_to_linear(static_cast<double>(n) / 255)));
  return table;
}

}  // namespace

std::shared_ptr<const CutoutMask> read_glass(std::string_view bytes, const std::array<MaskWrap, 2>& wrap,
                                             GlassAlpha alpha, double cutoff) {
  static const std::array<std::uint8_t, 256> linear = make_linear_table();
  const Picture picture = read_picture(bytes, kColourAndAlpha);
  auto mask = std::make_shared<CutoutMask>();
  mask->width = picture.width;
  mask->height = picture.height;
  mask->wrap = wrap;
  mask->blends = true;
  const auto share_there = [&](std::uint8_t value) -> std::uint8_t {
    if (alpha == GlassAlpha::cuts) return value >= 255 * cutoff ? 255 : 0;
    return alpha == GlassAlpha::blends ? value : 255;
  };
  const std::size_t texels = std::size_t{picture.width} * picture.height;
  for (std::size_t n = 0; n < texels; ++n) {
    const std::uint8_t* const rgba = picture.values.data() + kColourAndAlpha * n;
    mask->alpha.push_back(share_there(rgba[3]));
    mask->transmission.emplace_back(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]);
  }
  if (std::ranges::all_of(mask->transmission, [](const glm::u8vec3& rgb) { return rgb == glm::u8vec3(255); }))
    mask->transmission.clear();
  const bool is_opaque = std::ranges::all_of(mask->alpha, [](std::uint8_t share) { return share == 255; });
  if (is_opaque && mask->transmission.empty()) return nullptr;
  return mask;
}

}  // namespace pdsm
