// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// A picture's transparency.
struct AlphaImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> alpha;  ///< row by row from the top, 255 is opaque
  bool has_alpha = true;            ///< the picture has such a channel, or what stands for one
};

/// What stands for alpha in a picture without such a channel: nothing (it is opaque), or how bright it is.
enum class WithoutAlpha { opaque, brightness };

/// Reads a PNG, JPEG or TGA picture, a palette's transparency included. Throws FormatFault with the reason.
[[nodiscard]] AlphaImage read_alpha(std::string_view bytes, WithoutAlpha otherwise);

/// The mask of a surface that is there where `image` is at least `cutoff` opaque. Null where no texel is
/// less: nothing is cut out.
[[nodiscard]] std::shared_ptr<const CutoutMask> make_mask(AlphaImage image,
                                                          const std::array<MaskWrap, 2>& wrap, double cutoff);

/// The mask of a surface whose opacity is `image`'s alpha. Null where all of it is opaque.
[[nodiscard]] std::shared_ptr<const CutoutMask> make_blend(AlphaImage image,
                                                           const std::array<MaskWrap, 2>& wrap);

}  // namespace pdsm
