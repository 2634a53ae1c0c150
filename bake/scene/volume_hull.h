// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// First lattice points of the 8 x 8 x 8 cells between lattice points where a grid has any density, by z,
/// then y, then x. A brick reaches into the cells before its own, where density falls to 0.
[[nodiscard]] std::vector<glm::ivec3> occupied_cells(const DensityGrid& grid);

/// The closed surface around a volume's occupied cells, as geometry of the volume's name and placement: all
/// light that the volume takes away comes through it, or from inside. For what asks where casters are.
[[nodiscard]] Geometry volume_hull(const Volume& volume);

}  // namespace pdsm
