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
constexpr float kLargeTexels = 64;
/// Where the triangles lie that only fill a chunk up.
constexpr float kNowhere = -0x1p20F;

struct Corner {
  std::array<double, 2> g{};
  double k = 0;
};

class Projector {
 public:
  Projector(const MapGrid& grid, double first_depth, std::uint32_t threads)
      : grid_(grid), first_depth_(first_depth), threads_(threads) {
    result_.focus_depth = grid.focus_depth;
  }

  /// Every triangle's slots follow from those before it, so that threads can fill them in any order.
  void run(const LightSpaceScene& scene) {
    std::vector<std::vector<std::uint32_t>> first_slots;
    std::uint32_t slots = 0;
    for (const LightSpaceMesh& mesh : scene.meshes) first_slots.push_back(count_slots(mesh, slots));
    resize(slots);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const LightSpaceMesh& mesh = scene.meshes[m];
      if (!mesh.casts) continue;
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(threads_))
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        fill(mesh, mesh.triangles[t], static_cast<std::uint32_t>(m), first_slots[m][t]);
    }
    result_.bounds.resize(result_.k[0].size() / CasterTriangles::kChunk);
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(threads_))
    for (std::size_t chunk = 0; chunk < result_.bounds.size(); ++chunk)
      result_.bounds[chunk] = bound_chunk(chunk * CasterTriangles::kChunk);
    for (std::size_t chunk = 0; chunk < result_.bounds.size(); ++chunk) list_large(chunk, first_slots);
  }

  /// Whether floats serve.
  [[nodiscard]] bool is_near() const {
    return std::ranges::all_of(result_.bounds, [](const CasterTriangles::Bounds& bounds) {
      return bounds.least[0] >= -kFarthest && bounds.least[1] >= -kFarthest &&
             bounds.greatest[0] <= kFarthest && bounds.greatest[1] <= kFarthest;
    });
  }

  CasterTriangles release() {
    return std::move(result_);
  }

 private:
  /// First slot of each triangle, from `slots` on, which is moved behind them. What is cut off takes none, a
  /// triangle that loses one corner becomes two.
  [[nodiscard]] std::vector<std::uint32_t> count_slots(const LightSpaceMesh& mesh,
                                                       std::uint32_t& slots) const {
    std::vector<std::uint32_t> first;
    if (!mesh.casts) return first;
    first.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
      first.push_back(slots);
      const int kept = (is_behind(mesh.positions[t.x]) ? 1 : 0) + (is_behind(mesh.positions[t.y]) ? 1 : 0) +
                       (is_behind(mesh.positions[t.z]) ? 1 : 0);
      slots += kept == 0 ? 0 : kept == 2 ? 2 : 1;
    }
    return first;
  }

  [[nodiscard]] bool is_behind(const glm::dvec3& p) const {
    return p.z >= first_depth_;
  }

  void resize(std::size_t slots) {
    const std::size_t whole =
        (slots + CasterTriangles::kChunk - 1) / CasterTriangles::kChunk * CasterTriangles::kChunk;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      result_.k[corner].resize(whole, 0);
      for (auto& axis : result_.g) axis[corner].resize(whole, kNowhere);
    }
    result_.surfaces.resize(slots);
  }

  /// Fills a triangle's slots, from `slot` on.
  void fill(const LightSpaceMesh& mesh, const glm::uvec3& t, std::uint32_t mesh_index, std::uint32_t slot) {
    const glm::dvec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const CasterTriangles::Surface surface{
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]),
        mesh_index};
    Corner kept[4];
    int count = 0;
    for (int n = 0; n < 3; ++n) {
      const glm::dvec3 &a = p[n], &b = p[(n + 1) % 3];
      if (is_behind(a)) kept[count++] = project(a);
      if (is_behind(a) != is_behind(b)) kept[count++] = project(cut(a, b));
    }
    for (int n = 2; n < count; ++n, ++slot) {
      put(slot, 0, kept[0]);
      put(slot, 1, kept[n - 1]);
      put(slot, 2, kept[n]);
      result_.surfaces[slot] = surface;
    }
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

  void put(std::size_t slot, std::size_t n, const Corner& corner) {
    for (std::size_t axis = 0; axis < 2; ++axis)
      result_.g[axis][n][slot] = static_cast<float>(corner.g[axis]);
    result_.k[n][slot] = static_cast<float>(corner.k);
  }

  [[nodiscard]] std::size_t chunk_end(std::size_t first) const {
    return std::min(first + CasterTriangles::kChunk, result_.surfaces.size());
  }

  [[nodiscard]] CasterTriangles::Bounds bound_chunk(std::size_t first) const {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    CasterTriangles::Bounds bounds{{kMost, kMost}, {-kMost, -kMost}, kMost, -kMost};
    for (std::size_t t = first; t < chunk_end(first); ++t) {
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

  void list_large(std::size_t chunk, const std::vector<std::vector<std::uint32_t>>& first_slots) {
    const CasterTriangles::Bounds& bounds = result_.bounds[chunk];
    const auto is_wide = [&](std::size_t a) { return bounds.greatest[a] - bounds.least[a] >= kLargeTexels; };
    if (!is_wide(0) && !is_wide(1)) return;
    const std::size_t first = chunk * CasterTriangles::kChunk;
    for (std::size_t slot = first; slot < chunk_end(first); ++slot) {
      if (!is_large(slot)) continue;
      const std::uint32_t mesh = result_.surfaces[slot].mesh;
      const auto& slots = first_slots[mesh];
      const auto next = std::upper_bound(slots.begin(), slots.end(), slot);
      result_.large.push_back(
          {static_cast<std::uint32_t>(slot), mesh, static_cast<std::uint32_t>(next - slots.begin() - 1)});
    }
  }

  [[nodiscard]] bool is_large(std::size_t slot) const {
    for (const auto& corners : result_.g) {
      const auto [least, greatest] = std::minmax({corners[0][slot], corners[1][slot], corners[2][slot]});
      if (greatest - least >= kLargeTexels) return true;
    }
    return false;
  }

  const MapGrid& grid_;
  double first_depth_;
  std::uint32_t threads_;
  CasterTriangles result_;
};

}  // namespace

CasterTriangles project_casters(const LightSpaceScene& scene, const MapGrid& grid, double first_depth,
                                std::uint32_t threads) {
  std::size_t triangles = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) triangles += mesh.casts ? mesh.triangles.size() : 0;
  double texels = 1;
  for (std::size_t a = 0; a < 2; ++a) texels *= grid.texels[a] * grid.ratio[a].maps_per_texel();
  if (triangles == 0 || static_cast<double>(triangles) > kMostPerTexel * texels) return {};
  Projector projector(grid, first_depth, threads);
  projector.run(scene);
  return projector.is_near() ? projector.release() : CasterTriangles{};
}

}  // namespace pdsm
