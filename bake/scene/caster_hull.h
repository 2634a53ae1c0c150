// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"

/// Where casters are that are no meshes.
namespace pdsm {

/// The cells of a lattice that hold such a caster, and the surface around them.
struct CasterHull {
  std::vector<glm::ivec3> cells;  ///< their lower corners, by z, then y, then x
  std::int32_t edge = 1;          ///< of each
  /// Closed, in lattice coordinates, with the caster's name, lattice to world as its placement: all light
  /// that the caster takes away comes through it, or from inside.
  Geometry surface;
};

/// Lower corners of the 8 x 8 x 8 cells between lattice points where a grid has any density, by z, then y,
/// then x.
[[nodiscard]] std::vector<glm::ivec3> occupied_cells(const DensityGrid& grid);

/// The hull of cells in that order, each once.
[[nodiscard]] CasterHull make_hull(std::vector<glm::ivec3> cells, std::int32_t edge, const std::string& name,
                                   const glm::dmat4& lattice_to_world);

/// Of a volume: its occupied cells.
[[nodiscard]] CasterHull volume_hull(const Volume& volume);

/// Of curves: cells an edge of which is a 64th of their longest side.
[[nodiscard]] CasterHull curve_hull(const Curves& curves);

/// Of all that casts.
[[nodiscard]] std::vector<CasterHull> caster_hulls(const Scene& scene);

}  // namespace pdsm
