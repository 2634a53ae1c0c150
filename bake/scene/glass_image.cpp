// SPDX-License-Identifier: Apache-2.0
#include "scene/glass_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/srgb.h"

namespace pdsm {
namespace {

/// What the bytes of a channel stand for, 0 .. 1.
using ByteScale = std::array<double, 256>;

template <typename OfShare>
ByteScale make_scale(OfShare&& of_share) {
  ByteScale scale{};
  for (std::size_t n = 0; n < scale.size(); ++n) scale[n] = of_share(static_cast<double>(n) / 255);
  return scale;
}

const ByteScale kLinear = make_scale([](double share) { return share; });
const ByteScale kSrgb = make_scale(srgb_to_linear);

/// A picture of some size, asked for values of a mask that may be larger.
class PictureOnMask {
 public:
  PictureOnMask(const Picture& picture, std::uint32_t width, std::uint32_t height)
      : picture_(picture), x_(places(picture.width, width)), y_(places(picture.height, height)) {}

  /// Mixed of what bytes stand for.
  [[nodiscard]] double value(std::uint32_t i, std::uint32_t j, std::uint32_t channel,
                             const ByteScale& scale) const {
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
      const std::size_t texel = std::size_t{row} * picture_.width + column;
      return scale[picture_.values[kGlassChannels * texel + channel]];
    };
    const Place &x = x_[i], &y = y_[j];
    const double low = at(x.first, y.first) * (1 - x.beyond) + at(x.second, y.first) * x.beyond;
    if (y.beyond == 0) return low;
    const double high = at(x.first, y.second) * (1 - x.beyond) + at(x.second, y.second) * x.beyond;
    return low * (1 - y.beyond) + high * y.beyond;
  }

 private:
  /// Between the centres of two texels; at the border both are the last one.
  struct Place {
    std::uint32_t first = 0, second = 0;
    double beyond = 0;
  };
  static std::vector<Place> places(std::uint32_t texels, std::uint32_t of_mask) {
    std::vector<Place> result(of_mask);
    for (std::uint32_t n = 0; n < of_mask; ++n) {
      const double at = std::clamp((n + 0.5) * texels / of_mask - 0.5, 0.0, texels - 1.0);
      const auto first = static_cast<std::uint32_t>(at);
      result[n] = {first, std::min(first + 1, texels - 1), at - first};
    }
    return result;
  }

  const Picture& picture_;
  std::vector<Place> x_, y_;
};

std::uint8_t to_byte(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * share));
}

}  // namespace

std::shared_ptr<const CutoutMask> make_glass(const std::optional<Picture>& colour,
                                             const std::optional<Picture>& share,
                                             const std::array<MaskWrap, 2>& wrap, GlassAlpha alpha,
                                             double cutoff) {
  auto mask = std::make_shared<CutoutMask>();
  mask->width = std::max(colour ? colour->width : 1, share ? share->width : 1);
  mask->height = std::max(colour ? colour->height : 1, share ? share->height : 1);
  mask->wrap = wrap;
  mask->blends = true;
  std::optional<PictureOnMask> colours, shares;
  if (colour) colours.emplace(*colour, mask->width, mask->height);
  if (share) shares.emplace(*share, mask->width, mask->height);
  for (std::uint32_t j = 0; j < mask->height; ++j)
    for (std::uint32_t i = 0; i < mask->width; ++i) {
      const double own = colours ? colours->value(i, j, 3, kLinear) : 1;
      mask->alpha.push_back(alpha == GlassAlpha::cuts     ? (own >= cutoff ? 255 : 0)
                            : alpha == GlassAlpha::blends ? to_byte(own)
                                                          : 255);
      const double passes = shares ? shares->value(i, j, 0, kLinear) : 1;
      glm::u8vec3& rgb = mask->transmission.emplace_back();
      for (int c = 0; c < 3; ++c)
        rgb[c] = to_byte(passes * (colours ? colours->value(i, j, static_cast<std::uint32_t>(c), kSrgb) : 1));
    }
  if (std::ranges::all_of(mask->transmission, [](const glm::u8vec3& rgb) { return rgb == glm::u8vec3(255); }))
    mask->transmission.clear();
  const bool is_opaque = std::ranges::all_of(mask->alpha, [](std::uint8_t there) { return there == 255; });
  if (is_opaque && mask->transmission.empty()) return nullptr;
  return mask;
}

}  // namespace pdsm
