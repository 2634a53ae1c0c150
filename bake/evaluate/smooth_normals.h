// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Normals of a mesh's corners for shading, in its local space: the mean, by area, of the triangles around
/// the vertex (welded by position) that meet this one at less than the crease angle. Degenerate triangles
/// get zero normals. One array of three a triangle.
[[nodiscard]] std::vector<std::array<glm::vec3, 3>> smooth_normals(const Mesh& mesh);

}  // namespace pdsm
