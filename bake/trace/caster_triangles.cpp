// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/caster_order.h"

namespace pdsm {
namespace {

/// More triangles than this for each map texel, and finding them in a BVH takes less than looking at all.
constexpr double kMostPerTexel = 32;
/// Texels beside the map's lower corner. An edge function's rounding moves an edge by less than 2^-24 times
/// four such lengths: 1/128 of a texel, in the worst case.
constexpr float kFarthest = 0x1p15F;
/// Where the triangles lie that only fill a chunk up.
constexpr float kNowhere = -0x1p20F;

/// A triangle, or what is left of one, before it has a slot.
struct Part {
  ProjectedTriangle projected;
  CasterTriangles::Surface surface;
  std::uint32_t triangle = 0;
};

/// What one thread has projected: a run of the scene's triangles.
struct Run {
  std::vector<Part> parts;
  std::uint32_t first_id = 0;
};

class Projector {
 public:
  Projector(const LightSpaceScene& scene, const MapGrid& grid, double first_depth, std::uint32_t threads)
      : scene_(scene), grid_(grid), order_(grid), first_depth_(first_depth), runs_(threads) {
    result_.focus_depth = grid.focus_depth;
  }

  CasterTriangles run(std::size_t triangles) {
    const auto threads = static_cast<int>(runs_.size());
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t n = 0; n < runs_.size(); ++n)
      project_run(runs_[n], triangles * n / runs_.size(), triangles * (n + 1) / runs_.size());
    resize(number_parts());
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t n = 0; n < runs_.size(); ++n) describe(runs_[n]);
    CasterOrder::sort(keys_);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t chunk = 0; chunk < result_.bounds.size(); ++chunk) fill_chunk(chunk);
    const auto front = std::ranges::partition_point(keys_, CasterOrder::is_front) - keys_.begin();
    result_.front_chunks = chunks_of(static_cast<std::size_t>(front));
    list_large();
    return is_near() ? std::move(result_) : CasterTriangles{};
  }

 private:
  /// Projects the casting triangles from `begin` on, before `end`, counted through all meshes.
  void project_run(Run& run, std::size_t begin, std::size_t end) const {
    run.parts.reserve(end - begin);
    std::size_t first = 0;
    for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
      const LightSpaceMesh& mesh = scene_.meshes[m];
      if (!mesh.casts) continue;
      const std::size_t last = first + mesh.triangles.size();
      for (std::size_t t = std::max(begin, first); t < std::min(end, last); ++t)
        add_parts(mesh, static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(t - first), run.parts);
      first = last;
    }
  }

  /// What is cut off leaves no part, a triangle that loses one corner two.
  void add_parts(const LightSpaceMesh& mesh, std::uint32_t mesh_index, std::uint32_t triangle,
                 std::vector<Part>& parts) const {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const CasterTriangles::Surface surface{glm::cross(b - a, c - a), mesh_index};
    const glm::dvec3 p[3] = {a, b, c};
    glm::dvec3 kept[4];
    int count = 0;
    for (int n = 0; n < 3; ++n) {
      const glm::dvec3 &from = p[n], &to = p[(n + 1) % 3];
      if (is_behind(from)) kept[count++] = from;
      if (is_behind(from) != is_behind(to)) kept[count++] = cut(from, to);
    }
    for (int n = 2; n < count; ++n) {
      Part& part = parts.emplace_back(Part{{}, surface, triangle});
      project(kept[0], 0, part.projected);
      project(kept[n - 1], 1, part.projected);
      project(kept[n], 2, part.projected);
    }
  }

  [[nodiscard]] bool is_behind(const glm::dvec3& p) const {
    return p.z >= first_depth_;
  }

  void project(const glm::dvec3& p, std::size_t corner, ProjectedTriangle& result) const {
    for (std::size_t a = 0; a < 2; ++a)
      result.g[a][corner] =
          static_cast<float>((p[static_cast<int>(a)] / p.z - grid_.origin[a]) / grid_.pitch[a]);
    result.k[corner] = static_cast<float>(1 / grid_.focus_depth - 1 / p.z);
  }

  /// Where an edge meets the first depth: the same for both triangles that share it.
  [[nodiscard]] glm::dvec3 cut(glm::dvec3 a, glm::dvec3 b) const {
    if (b.z < a.z) std::swap(a, b);
    glm::dvec3 p = a + (b - a) * ((first_depth_ - a.z) / (b.z - a.z));
    p.z = first_depth_;
    return p;
  }

  /// Gives ids to all parts, and tells how many there are.
  std::size_t number_parts() {
    std::size_t count = 0;
    for (Run& run : runs_) {
      run.first_id = static_cast<std::uint32_t>(count);
      count += run.parts.size();
    }
    return count;
  }

  [[nodiscard]] const Part& part(std::uint32_t id) const {
    const auto next = std::ranges::upper_bound(runs_, id, {}, &Run::first_id);
    const Run& run = *std::prev(next);
    return run.parts[id - run.first_id];
  }

  static std::uint32_t chunks_of(std::size_t slots) {
    return static_cast<std::uint32_t>((slots + CasterTriangles::kChunk - 1) / CasterTriangles::kChunk);
  }

  void resize(std::size_t slots) {
    const std::size_t whole = std::size_t{chunks_of(slots)} * CasterTriangles::kChunk;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      result_.k[corner].resize(whole, 0);
      for (auto& axis : result_.g) axis[corner].resize(whole, kNowhere);
    }
    result_.ids.resize(whole, 0);
    result_.bounds.resize(chunks_of(slots));
    result_.surfaces.resize(slots);
    keys_.resize(slots);
  }

  void describe(const Run& run) {
    std::uint32_t id = run.first_id;
    for (const Part& part : run.parts) {
      result_.surfaces[id] = part.surface;
      keys_[id] = order_.key(part.projected, id);
      ++id;
    }
  }

  void fill_chunk(std::size_t chunk) {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    CasterTriangles::Bounds bounds{{kMost, kMost}, {-kMost, -kMost}, kMost, -kMost};
    const std::size_t first = chunk * CasterTriangles::kChunk,
                      last = std::min(first + CasterTriangles::kChunk, keys_.size());
    for (std::size_t slot = first; slot < last; ++slot) {
      result_.ids[slot] = static_cast<std::uint32_t>(keys_[slot]);
      put(slot, part(result_.ids[slot]).projected, bounds);
    }
    result_.bounds[chunk] = bounds;
  }

  void put(std::size_t slot, const ProjectedTriangle& triangle, CasterTriangles::Bounds& bounds) {
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t a = 0; a < 2; ++a) {
        result_.g[a][n][slot] = triangle.g[a][n];
        bounds.least[a] = std::min(bounds.least[a], triangle.g[a][n]);
        bounds.greatest[a] = std::max(bounds.greatest[a], triangle.g[a][n]);
      }
      result_.k[n][slot] = triangle.k[n];
      bounds.least_k = std::min(bounds.least_k, triangle.k[n]);
      bounds.greatest_k = std::max(bounds.greatest_k, triangle.k[n]);
    }
  }

  /// Large triangles have the first slots.
  void list_large() {
    for (std::uint32_t slot = 0; slot < keys_.size(); ++slot) {
      const Part& here = part(result_.ids[slot]);
      if (!here.projected.is_large()) return;
      result_.large.push_back({slot, here.surface.mesh, here.triangle});
    }
  }

  /// Whether floats serve.
  [[nodiscard]] bool is_near() const {
    return std::ranges::all_of(result_.bounds, [](const CasterTriangles::Bounds& bounds) {
      return bounds.least[0] >= -kFarthest && bounds.least[1] >= -kFarthest &&
             bounds.greatest[0] <= kFarthest && bounds.greatest[1] <= kFarthest;
    });
  }

  const LightSpaceScene& scene_;
  const MapGrid& grid_;
  const CasterOrder order_;
  double first_depth_;
  std::vector<Run> runs_;
  std::vector<std::uint64_t> keys_;  // CasterOrder
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
  return Projector(scene, grid, first_depth, threads).run(triangles);
}

}  // namespace pdsm
