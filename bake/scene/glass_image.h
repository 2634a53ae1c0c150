// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "pdsm/bake/scene.h"
#include "scene/picture.h"

namespace pdsm {

/// What a picture's alpha tells of glass: nothing, how much of it is there, or where it is.
enum class GlassAlpha { none, blends, cuts };

/// Channels of the pictures that make_glass() takes: colour and alpha.
inline constexpr std::uint32_t kGlassChannels = 4;

/// The mask of glass with two pictures, either of which may be missing: the sRGB colours of `colour` are what
/// light that passes keeps, and its alpha is as told above; the red of `share`, linear, is by what the glass'
/// transmission is multiplied. The mask is as large as the larger one along each axis; of the other it takes
/// what is there, linear between texels. Where alpha `cuts`, glass is where it is at least `cutoff`. Null for
/// what lets all light through everywhere as the material says.
[[nodiscard]] std::shared_ptr<const CutoutMask> make_glass(const std::optional<Picture>& colour,
                                                           const std::optional<Picture>& share,
                                                           const std::array<MaskWrap, 2>& wrap,
                                                           GlassAlpha alpha, double cutoff);

}  // namespace pdsm
