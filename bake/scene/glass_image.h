// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What a picture's alpha tells of glass: nothing, how much of it is there, or where it is.
enum class GlassAlpha { none, blends, cuts };

/// The mask of glass that is coloured by a PNG, JPEG or TGA picture: its sRGB colours are what light that
/// passes keeps. Where alpha `cuts`, glass is where it is at least `cutoff`. Null for a picture that is white
/// and of glass everywhere. Throws FormatFault with the reason.
[[nodiscard]] std::shared_ptr<const CutoutMask> read_glass(std::string_view bytes,
                                                           const std::array<MaskWrap, 2>& wrap,
                                                           GlassAlpha alpha, double cutoff);

}  // namespace pdsm
