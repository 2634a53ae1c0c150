// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pdsm/bake/volume.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

bool is_before(const DensityBrick& a, const DensityBrick& b) {
  const auto key = [](const glm::ivec3& p) { return std::tuple(p.z, p.y, p.x); };
  return key(a.first) < key(b.first);
}

bool is_placed(const glm::ivec3& first) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t at = first[axis];
    if (at % DensityBrick::kEdge != 0 || at < -kMostLatticeCoordinate || at > kMostLatticeCoordinate)
      return false;
  }
  return true;
}

/// Bricks that fit the box around all.
double count_places(const DensityGrid& grid) {
  if (grid.bricks.empty()) return 0;
  glm::ivec3 low = grid.bricks.front().first, high = low;
  for (const DensityBrick& brick : grid.bricks) {
    low = glm::min(low, brick.first);
    high = glm::max(high, brick.first);
  }
  const glm::dvec3 across = glm::dvec3(high - low) / double{DensityBrick::kEdge} + 2.0;
  return across.x * across.y * across.z;
}

const char* fault_of(const DensityGrid& grid) {
  if (grid.bricks.size() > kMostBricks) return "has more than 1048576 bricks of 8 x 8 x 8 voxels";
  for (const DensityBrick& brick : grid.bricks) {
    if (!is_placed(brick.first)) return "has a brick off the lattice of bricks, or more than 2^22 voxels out";
    if (!std::ranges::all_of(brick.density, [](float x) { return x >= 0 && std::isfinite(x); }))
      return "has densities that are negative, infinite or NaN";
  }
  const auto out_of_order = [](const DensityBrick& a, const DensityBrick& b) { return !is_before(a, b); };
  if (std::ranges::adjacent_find(grid.bricks, out_of_order) != grid.bricks.end())
    return "has bricks out of order, or one twice";
  if (count_places(grid) > static_cast<double>(kMostBrickPlaces)) return "spans too many voxels";
  return nullptr;
}

bool is_affine(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row)
      if (!std::isfinite(m[column][row])) return false;
    if (m[column][3] != (column == 3 ? 1 : 0)) return false;
  }
  return true;
}

}  // namespace

void check_volume(const Volume& volume) {
  const auto refuse = [&](const char* field, const char* reason) {
    throw Error(Failure::input, volume.name + ":" + field, reason);
  };
  if (!volume.grid) refuse("grid", "is missing");
  if (const char* reason = fault_of(*volume.grid)) refuse("grid", reason);
  if (!(volume.extinction >= 0 && std::isfinite(volume.extinction)))
    refuse("extinction", "must be a number >= 0");
  const double determinant = glm::determinant(glm::dmat3(volume.index_to_world));
  if (!is_affine(volume.index_to_world) || determinant == 0 || !std::isfinite(determinant))
    refuse("index_to_world", "must be affine, finite and not singular");
}

}  // namespace pdsm
