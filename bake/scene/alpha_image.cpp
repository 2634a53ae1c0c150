// SPDX-License-Identifier: Apache-2.0
#include "scene/alpha_image.h"

#include <algorithm>
#include <utility>

#include "scene/picture.h"

namespace pdsm {
namespace {

static_assert(kMostPictureTexels == kMostMaskTexels);

/// Cutoffs above 1 leave nothing; how far above does not matter.
constexpr double kNothingLeft = 2;

}  // namespace

AlphaImage read_alpha(std::string_view bytes, WithoutAlpha otherwise) {
  constexpr std::uint32_t kGreyAndAlpha = 2;
  const Picture picture = read_picture(bytes, kGreyAndAlpha);
  const bool alpha_channel = picture.file_channels == 2 || picture.file_channels == 4;
  AlphaImage image{picture.width, picture.height, {}, true};
  image.has_alpha = alpha_channel || otherwise == WithoutAlpha::brightness;
  image.alpha.resize(std::size_t{image.width} * image.height);
  const std::size_t channel = alpha_channel ? 1 : 0;
  for (std::size_t n = 0; n < image.alpha.size(); ++n)
    image.alpha[n] = image.has_alpha ? picture.values[kGreyAndAlpha * n + channel] : 255;
  return image;
}

std::shared_ptr<const CutoutMask> make_mask(AlphaImage image, const std::array<MaskWrap, 2>& wrap,
                                            double cutoff) {
  const auto least = static_cast<float>(std::clamp(cutoff, 0.0, kNothingLeft));
  const bool is_whole = std::ranges::all_of(
      image.alpha, [&](std::uint8_t alpha) { return alpha >= 255.0 * static_cast<double>(least); });
  if (is_whole) return nullptr;
  CutoutMask mask{image.width, image.height, std::move(image.alpha), wrap, least};
  return std::make_shared<const CutoutMask>(std::move(mask));
}

std::shared_ptr<const CutoutMask> make_blend(AlphaImage image, const std::array<MaskWrap, 2>& wrap) {
  if (std::ranges::all_of(image.alpha, [](std::uint8_t alpha) { return alpha == 255; })) return nullptr;
  return std::make_shared<const CutoutMask>(
      CutoutMask{image.width, image.height, std::move(image.alpha), wrap, 0, true});
}

}  // namespace pdsm
