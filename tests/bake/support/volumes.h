// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <tuple>

#include "pdsm/bake/scene.h"

/// Volumes made in memory.
namespace pdsm::test {

/// The grid whose density is density(x, y, z) at lattice points `low` .. `high`, and 0 beyond.
template <typename Density>
[[nodiscard]] std::shared_ptr<const DensityGrid> make_grid(const glm::ivec3& low, const glm::ivec3& high,
                                                           Density&& density) {
  constexpr int kEdge = DensityBrick::kEdge;
  std::map<std::tuple<int, int, int>, DensityBrick> bricks;
  const auto first_of = [](int x) { return (x >= 0 ? x : x - (kEdge - 1)) / kEdge * kEdge; };
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const glm::ivec3 first(first_of(x), first_of(y), first_of(z));
        DensityBrick& brick = bricks[{first.z, first.y, first.x}];
        brick.first = first;
        brick.density[DensityBrick::at(x - first.x, y - first.y, z - first.z)] =
            static_cast<float>(density(x, y, z));
      }
    }
  }
  auto grid = std::make_shared<DensityGrid>();
  for (const auto& [key, brick] : bricks) grid->bricks.push_back(brick);
  return grid;
}

[[nodiscard]] inline glm::dmat4 scaled_and_moved(const glm::dvec3& scale, const glm::dvec3& move) {
  glm::dmat4 m(1.0);
  for (int axis = 0; axis < 3; ++axis) m[axis][axis] = scale[axis];
  m[3] = glm::dvec4(move, 1.0);
  return m;
}

/// A slab across the light's axis, far wider than anything that it sees: lattice points 1 .. `layers` along
/// z, `voxel` apart, have density 1, and the 0th lies at depth `begin`.
struct Slab {
  double begin = 3, voxel = 0.25;
  int layers = 7;

  [[nodiscard]] Volume volume(double extinction) const {
    Volume slab;
    slab.name = "slab";
    slab.grid = make_grid({0, 0, 1}, {7, 7, layers}, [](int, int, int) { return 1; });
    slab.index_to_world = scaled_and_moved({100, 100, voxel}, {-350, -350, begin});
    slab.extinction = extinction;
    return slab;
  }
  /// The integral of density along z up to depth z: trilinear, it rises and falls over a voxel.
  [[nodiscard]] double integral(double z) const {
    const double x = (z - begin) / voxel, top = layers;
    if (x <= 0) return 0;
    if (x <= 1) return voxel * x * x / 2;
    if (x <= top) return voxel * (x - 0.5);
    const double left = top + 1 - x;
    return voxel * (top - (left > 0 ? left * left / 2 : 0));
  }
};

}  // namespace pdsm::test
