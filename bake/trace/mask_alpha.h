// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Where `at`, u or v and finite, lies along that axis of a copy of the mask that has `count` texels there: 0
/// is the centre of the first. From -1/2 to count - 1/2.
[[nodiscard]] double texel_at(double at, std::uint32_t count, MaskWrap wrap);

/// Whether a surface with this mask is there where its alpha is `alpha`, in units of 1/255.
[[nodiscard]] inline bool is_solid_alpha(const CutoutMask& mask, double alpha) {
  return alpha >= 255.0 * static_cast<double>(mask.cutoff);
}

/// A mask's alpha at `place` (u, v), which is finite, in units of 1/255: linear between the centres of
/// texels. Any thread.
[[nodiscard]] double alpha_at(const CutoutMask& mask, const glm::dvec2& place);

/// Whether a surface with this mask is there at `place` (u, v), which is finite: its alpha, linear between
/// the centres of texels, is at least the cutoff. Any thread.
[[nodiscard]] bool is_solid(const CutoutMask& mask, const glm::dvec2& place);

}  // namespace pdsm
