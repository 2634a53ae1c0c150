// SPDX-License-Identifier: Apache-2.0
#include "trace/mask_alpha.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pdsm {
namespace {

/// Two neighbouring texels of a row or column, and how far a place is from the first to the second.
struct TexelPair {
  std::size_t first = 0, second = 0;
  double share = 0;
};

/// x >= 0 or little less, rounded down.
std::int64_t floor_of(double x) {
  const auto whole = static_cast<std::int64_t>(x);
  return whole - (static_cast<double>(whole) > x ? 1 : 0);
}

/// The texel that shows as number -1 .. count: of what is repeated, the row goes on with its other end.
std::size_t shown_texel(std::int64_t texel, std::int64_t count, MaskWrap wrap) {
  if (wrap == MaskWrap::repeat)
    return static_cast<std::size_t>(texel < 0 ? count - 1 : texel < count ? texel : 0);
  return static_cast<std::size_t>(std::clamp<std::int64_t>(texel, 0, count - 1));
}

/// From 0 to 1; whole copies are taken off first, as places may be larger than any integer.
double place_in_copy(double at, MaskWrap wrap) {
  if (wrap == MaskWrap::clamp) return std::clamp(at, 0.0, 1.0);
  if (wrap == MaskWrap::repeat) return at - std::floor(at);
  return std::abs(at - 2 * std::floor(at / 2 + 0.5));
}

TexelPair texels_at(double at, std::uint32_t count, MaskWrap wrap) {
  const double texel = texel_at(at, count, wrap);
  const std::int64_t n = floor_of(texel);
  return {shown_texel(n, count, wrap), shown_texel(n + 1, count, wrap), texel - static_cast<double>(n)};
}

}  // namespace

double texel_at(double at, std::uint32_t count, MaskWrap wrap) {
  return place_in_copy(at, wrap) * count - 0.5;
}

double alpha_at(const CutoutMask& mask, const glm::dvec2& place) {
  const TexelPair x = texels_at(place.x, mask.width, mask.wrap[0]),
                  y = texels_at(place.y, mask.height, mask.wrap[1]);
  const auto row = [&](std::size_t j) {
    const std::uint8_t* const alpha = mask.alpha.data() + j * mask.width;
    // Of this form, the mean of equal values is that value.
    return alpha[x.first] + x.share * (alpha[x.second] - alpha[x.first]);
  };
  const double low = row(y.first), high = row(y.second);
  return low + y.share * (high - low);
}

bool is_solid(const CutoutMask& mask, const glm::dvec2& place) {
  return is_solid_alpha(mask, alpha_at(mask, place));
}

}  // namespace pdsm
