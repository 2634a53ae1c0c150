// SPDX-License-Identifier: Apache-2.0
#include "scene/volume_hull.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace pdsm {
namespace {

constexpr std::int32_t kEdge = DensityBrick::kEdge;

bool is_before(const glm::ivec3& a, const glm::ivec3& b) {
  return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
}

/// Whether a brick has any density in its first layer along the axes of `along`.
bool has_density(const DensityBrick& brick, const glm::ivec3& along) {
  const glm::ivec3 end = glm::mix(glm::ivec3(kEdge), glm::ivec3(1), glm::equal(along, glm::ivec3(1)));
  for (int z = 0; z < end.z; ++z)
    for (int y = 0; y < end.y; ++y)
      for (int x = 0; x < end.x; ++x)
        if (brick.density[DensityBrick::at(x, y, z)] > 0) return true;
  return false;
}

/// Gathers faces of cells, whose corners many share.
class HullMesh {
 public:
  /// The face of the cells at `first` that looks along `axis`, forwards or backwards.
  void add_face(const glm::ivec3& first, int axis, bool forwards) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::ivec3 corner = first;
    if (forwards) corner[axis] += kEdge;
    std::array<std::uint32_t, 4> n{};
    n[0] = vertex(corner);
    corner[u] += kEdge;
    n[1] = vertex(corner);
    corner[v] += kEdge;
    n[2] = vertex(corner);
    corner[u] -= kEdge;
    n[3] = vertex(corner);
    if (!forwards) std::swap(n[1], n[3]);
    mesh_->triangles.emplace_back(n[0], n[1], n[2]);
    mesh_->triangles.emplace_back(n[0], n[2], n[3]);
  }
  [[nodiscard]] std::shared_ptr<Mesh> release() { return mesh_; }

 private:
  std::uint32_t vertex(const glm::ivec3& p) {
    const auto [known, fresh] = vertices_.emplace(std::tuple(p.z, p.y, p.x), mesh_->positions.size());
    if (fresh) mesh_->positions.emplace_back(p);
    return known->second;
  }

  std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, std::uint32_t> vertices_;
  std::shared_ptr<Mesh> mesh_ = std::make_shared<Mesh>();
};

}  // namespace

std::vector<glm::ivec3> occupied_cells(const DensityGrid& grid) {
  std::vector<glm::ivec3> cells;
  for (const DensityBrick& brick : grid.bricks) {
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 before(n & 1, n >> 1 & 1, n >> 2 & 1);
      if (has_density(brick, before)) cells.push_back(brick.first - kEdge * before);
    }
  }
  std::ranges::sort(cells, is_before);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

Geometry volume_hull(const Volume& volume) {
  const std::vector<glm::ivec3> cells = occupied_cells(*volume.grid);
  HullMesh hull;
  for (const glm::ivec3& first : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool forwards : {false, true}) {
        glm::ivec3 beside = first;
        beside[axis] += forwards ? kEdge : -kEdge;
        if (!std::ranges::binary_search(cells, beside, is_before)) hull.add_face(first, axis, forwards);
      }
    }
  }
  Geometry geometry;
  geometry.name = volume.name;
  geometry.mesh = hull.release();
  geometry.local_to_world = volume.index_to_world;
  geometry.casts = casts_shadows(volume);
  geometry.receives = false;
  return geometry;
}

}  // namespace pdsm
