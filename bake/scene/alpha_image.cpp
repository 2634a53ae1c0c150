// SPDX-License-Identifier: Apache-2.0
#include "scene/alpha_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "scene/format_fault.h"

// Pictures alone that models are textured with; files are read through FileSource only.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace pdsm {
namespace {

static_assert(STBI_MAX_DIMENSIONS == kMostMaskTexels);

/// Cutoffs above 1 leave nothing; how far above does not matter.
constexpr double kNothingLeft = 2;

struct FreePicture {
  void operator()(stbi_uc* picture) const { stbi_image_free(picture); }
};

[[noreturn]] void refuse() {
  const char* const reason = stbi_failure_reason();
  throw FormatFault(fmt::format("is not a PNG, JPEG or TGA picture that can be read ({})",
                                reason != nullptr ? reason : "unknown fault"));
}

}  // namespace

AlphaImage read_alpha(std::string_view bytes, WithoutAlpha otherwise) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw FormatFault("is larger than 2 GiB");
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  int width = 0, height = 0, channels = 0;
  constexpr int kGreyAndAlpha = 2;
  const std::unique_ptr<stbi_uc, FreePicture> picture(
      stbi_load_from_memory(data, static_cast<int>(bytes.size()), &width, &height, &channels, kGreyAndAlpha));
  if (!picture) refuse();
  AlphaImage image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}, true};
  const bool alpha_channel = channels == 2 || channels == 4;
  image.has_alpha = alpha_channel || otherwise == WithoutAlpha::brightness;
  image.alpha.resize(std::size_t{image.width} * image.height);
  const std::size_t channel = alpha_channel ? 1 : 0;
  for (std::size_t n = 0; n < image.alpha.size(); ++n)
    image.alpha[n] = image.has_alpha ? picture.get()[kGreyAndAlpha * n + channel] : 255;
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

}  // namespace pdsm
