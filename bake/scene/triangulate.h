// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pdsm {

/// Appends the triangles of a simple polygon, convex or not, wound as it is. `polygon` holds indices into
/// `positions`, all in range; fewer than three give nothing.
void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles);

}  // namespace pdsm
