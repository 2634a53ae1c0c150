// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Where `at`, which is finite, lies along one axis of a copy of the mask, from 0 to 1. Whole copies are
/// taken off, as places may be larger than any integer.
[[nodiscard]] double place_in_copy(double at, MaskWrap wrap);

/// A mask's alpha at `place` (u, v), which is finite, in units of 1/255: linear between the centres of
/// texels. Any thread.
[[nodiscard]] double alpha_at(const CutoutMask& mask, const glm::dvec2& place);

/// Whether a surface with this mask is there at `place` (u, v), which is finite: its alpha, linear between
/// the centres of texels, is at least the cutoff. Any thread.
[[nodiscard]] bool is_solid(const CutoutMask& mask, const glm::dvec2& place);

}  // namespace pdsm
