// SPDX-License-Identifier: Apache-2.0
#include "scene/caster_hull.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace pdsm {
namespace {

bool is_before(const glm::ivec3& a, const glm::ivec3& b) {
  return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
}

/// Gathers faces of cells, whose corners many share.
class HullMesh {
 public:
  explicit HullMesh(std::int32_t edge) : edge_(edge) {}

  /// The face of the cell at `first` that looks along `axis`, forwards or backwards.
  void add_face(const glm::ivec3& first, int axis, bool forwards) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::ivec3 corner = first;
    if (forwards) corner[axis] += edge_;
    std::array<std::uint32_t, 4> n{};
    n[0] = vertex(corner);
    corner[u] += edge_;
    n[1] = vertex(corner);
    corner[v] += edge_;
    n[2] = vertex(corner);
    corner[u] -= edge_;
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

  std::int32_t edge_;
  std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, std::uint32_t> vertices_;
  std::shared_ptr<Mesh> mesh_ = std::make_shared<Mesh>();
};

std::shared_ptr<Mesh> surface_of(const std::vector<glm::ivec3>& cells, std::int32_t edge) {
  HullMesh hull(edge);
  for (const glm::ivec3& first : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool forwards : {false, true}) {
        glm::ivec3 beside = first;
        beside[axis] += forwards ? edge : -edge;
        if (!std::ranges::binary_search(cells, beside, is_before)) hull.add_face(first, axis, forwards);
      }
    }
  }
  return hull.release();
}

}  // namespace

CasterHull make_hull(std::vector<glm::ivec3> cells, std::int32_t edge, const std::string& name,
                     const glm::dmat4& lattice_to_world) {
  CasterHull hull{std::move(cells), edge, {}};
  hull.surface.name = name;
  hull.surface.mesh = surface_of(hull.cells, edge);
  hull.surface.local_to_world = lattice_to_world;
  hull.surface.receives = false;
  return hull;
}

std::vector<CasterHull> caster_hulls(const Scene& scene) {
  std::vector<CasterHull> hulls;
  for (const Volume& volume : scene.volumes)
    if (casts_shadows(volume)) hulls.push_back(volume_hull(volume));
  for (const Curves& curves : scene.curves)
    if (casts_shadows(curves)) hulls.push_back(curve_hull(curves));
  return hulls;
}

}  // namespace pdsm
