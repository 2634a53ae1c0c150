// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>

#include "scene/caster_hull.h"

namespace pdsm {
namespace {

constexpr std::int32_t kEdge = DensityBrick::kEdge;

/// Whether a brick has any density in its first layer along the axes of `along`.
bool has_density(const DensityBrick& brick, const glm::ivec3& along) {
  const glm::ivec3 end = glm::mix(glm::ivec3(kEdge), glm::ivec3(1), glm::equal(along, glm::ivec3(1)));
  for (int z = 0; z < end.z; ++z)
    for (int y = 0; y < end.y; ++y)
      for (int x = 0; x < end.x; ++x)
        if (brick.density[DensityBrick::at(x, y, z)] > 0) return true;
  return false;
}

}  // namespace

std::vector<glm::ivec3> occupied_cells(const DensityGrid& grid) {
  std::vector<glm::ivec3> cells;
  // A brick reaches into the cells before its own, where density falls to 0.
  for (const DensityBrick& brick : grid.bricks) {
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 before(n & 1, n >> 1 & 1, n >> 2 & 1);
      if (has_density(brick, before)) cells.push_back(brick.first - kEdge * before);
    }
  }
  const auto is_before = [](const glm::ivec3& a, const glm::ivec3& b) {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  };
  std::ranges::sort(cells, is_before);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

CasterHull volume_hull(const Volume& volume) {
  return make_hull(occupied_cells(*volume.grid), kEdge, volume.name, volume.index_to_world);
}

}  // namespace pdsm
