// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// More triangles than this for each map texel, and finding them in a BVH takes less than looking at all.
constexpr double kMostPerTexel = 32;
/// Texels beside the map's lower corner. An edge function's rounding moves an edge by less than 2^-24 times
/// four such lengths: 1/128 of a texel, in the worst case.
constexpr float kFarthest = 0x1p15F;
/// Texels along an axis from which on a triangle is large.
constexpr double kLargeTexels = 64;
/// Where the triangles lie that only fill a chunk up.
constexpr float kNowhere = -0x1p20F;

struct Corner {
  std::array<double, 2> g{};
  double k = 0;
};

class Projector {
 public:
  Projector(const MapGrid& grid, double first_depth) : grid_(grid), first_depth_(first_depth) {
    result_.focus_depth = grid.focus_depth;
  }

  void reserve(std::size_t triangles) {
    const std::size_t slots = (triangles / CasterTriangles::kChunk + 1) * CasterTriangles::kChunk;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      result_.k[corner].reserve(slots);
      for (auto& axis : result_.g) axis[corner].reserve(slots);
    }
    result_.surfaces.reserve(triangles);
  }

  void add(const LightSpaceMesh& mesh, std::uint32_t mesh_index, std::uint32_t triangle) {
    const auto before = static_cast<std::uint32_t>(result_.surfaces.size());
    append_parts(mesh, mesh.triangles[triangle], mesh_index);
    for (auto slot = before; slot < result_.surfaces.size(); ++slot)
      if (is_large(slot)) result_.large.push_back({slot, mesh_index, triangle});
  }

  CasterTriangles release() {
    while (result_.k[0].size() % CasterTriangles::kChunk != 0) append_nothing();
    for (std::size_t first = 0; first < result_.k[0].size(); first += CasterTriangles::kChunk)
      result_.bounds.push_back(bound_chunk(first));
    return too_far_ ? CasterTriangles{} : std::move(result_);
  }

 private:
  /// Appends what is left of a triangle behind the first depth: one triangle, two, or none.
  void append_parts(const LightSpaceMesh& mesh, const glm::uvec3& t, std::uint32_t mesh_index) {
    const glm::dvec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const CasterTriangles::Surface surface{
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]),
        mesh_index};
    if (p[0].z >= first_depth_ && p[1].z >= first_depth_ && p[2].z >= first_depth_) {
      append(project(p[0]), project(p[1]), project(p[2]), surface);
      return;
    }
    Corner kept[4];
    int count = 0;
    for (int n = 0; n < 3; ++n) {
      const glm::dvec3 &a = p[n], &b = p[(n + 1) % 3];
      if (a.z >= first_depth_) kept[count++] = project(a);
      if ((a.z >= first_depth_) != (b.z >= first_depth_)) kept[count++] = project(cut(a, b));
    }
    for (int n = 2; n < count; ++n) append(kept[0], kept[n - 1], kept[n], surface);
  }

  [[nodiscard]] bool is_large(std::size_t slot) const {
    for (const auto& corners : result_.g) {
      const auto [least, greatest] = std::minmax({corners[0][slot], corners[1][slot], corners[2][slot]});
      if (static_cast<double>(greatest) - static_cast<double>(least) >= kLargeTexels) return true;
    }
    return false;
  }

  [[nodiscard]] Corner project(const glm::dvec3& p) const {
    Corner corner;
    for (std::size_t a = 0; a < 2; ++a)
      corner.g[a] = (p[static_cast<int>(a)] / p.z - grid_.origin[a]) / grid_.pitch[a];
    corner.k = 1 / grid_.focus_depth - 1 / p.z;
    return corner;
  }

  /// Where an edge meets the first depth: the same for both triangles that share it.
  [[nodiscard]] glm::dvec3 cut(glm::dvec3 a, glm::dvec3 b) const {
    if (b.z < a.z) std::swap(a, b);
    glm::dvec3 p = a + (b - a) * ((first_depth_ - a.z) / (b.z - a.z));
    p.z = first_depth_;
    return p;
  }

  void append(const Corner& a, const Corner& b, const Corner& c, const CasterTriangles::Surface& surface) {
    const Corner* const corners[3] = {&a, &b, &c};
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto g = static_cast<float>(corners[n]->g[axis]);
        too_far_ = too_far_ || !(std::abs(g) <= kFarthest);
        result_.g[axis][n].push_back(g);
      }
      result_.k[n].push_back(static_cast<float>(corners[n]->k));
    }
    result_.surfaces.push_back(surface);
  }

  void append_nothing() {
    for (std::size_t n = 0; n < 3; ++n) {
      for (auto& axis : result_.g) axis[n].push_back(kNowhere);
      result_.k[n].push_back(0);
    }
  }

  [[nodiscard]] CasterTriangles::Bounds bound_chunk(std::size_t first) const {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    CasterTriangles::Bounds bounds{{kMost, kMost}, {-kMost, -kMost}, kMost, -kMost};
    const std::size_t last = std::min(first + CasterTriangles::kChunk, result_.surfaces.size());
    for (std::size_t t = first; t < last; ++t) {
      for (std::size_t n = 0; n < 3; ++n) {
        for (std::size_t a = 0; a < 2; ++a) {
          bounds.least[a] = std::min(bounds.least[a], result_.g[a][n][t]);
          bounds.greatest[a] = std::max(bounds.greatest[a], result_.g[a][n][t]);
        }
        bounds.least_k = std::min(bounds.least_k, result_.k[n][t]);
        bounds.greatest_k = std::max(bounds.greatest_k, result_.k[n][t]);
      }
    }
    return bounds;
  }

  const MapGrid& grid_;
  double first_depth_;
  CasterTriangles result_;
  bool too_far_ = false;
};

}  // namespace

CasterTriangles project_casters(const LightSpaceScene& scene, const MapGrid& grid, double first_depth) {
  std::size_t triangles = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) triangles += mesh.casts ? mesh.triangles.size() : 0;
  double texels = 1;
  for (std::size_t a = 0; a < 2; ++a) texels *= grid.texels[a] * grid.ratio[a].maps_per_texel();
  if (triangles == 0 || static_cast<double>(triangles) > kMostPerTexel * texels) return {};
  Projector projector(grid, first_depth);
  projector.reserve(triangles);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const LightSpaceMesh& mesh = scene.meshes[m];
    if (!mesh.casts) continue;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      projector.add(mesh, static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(t));
  }
  return projector.release();
}

}  // namespace pdsm
