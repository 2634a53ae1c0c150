// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// A mask's alpha at `place` (u, v), 0 .. 1: bilinear at its full resolution. Any thread.
[[nodiscard]] double mask_alpha(const CutoutMask& mask, const glm::dvec2& place);

/// Whether a mask has a hole at `place` (u, v): alpha, bilinear at the mask's full resolution, is less than
/// its cutoff; never where it blends. It has nothing in common with the baker's own test. Any thread.
[[nodiscard]] bool is_hole(const CutoutMask& mask, const glm::dvec2& place);

/// Whether the mesh has a hole at a point of a triangle; `weights` of its corners. False without a mask.
[[nodiscard]] bool is_hole(const Mesh& mesh, const glm::uvec3& triangle, const glm::dvec3& weights);

}  // namespace pdsm
