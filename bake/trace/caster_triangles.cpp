// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/caster_order.h"
#include "trace/caster_volume.h"

namespace pdsm {
namespace {

/// More triangles than this for each map texel, and finding them in a BVH takes less than looking at all.
constexpr double kMostPerTexel = 32;
/// Texels beside the map's lower corner. An edge function's rounding moves an edge by less than 2^-24 times
/// four such lengths: 1/128 of a texel, in the worst case.
constexpr float kFarthest = 0x1p15F;
/// The same in any sample's map: 1/16 of a texel, for what is so close to the light that it hides half of it.
constexpr float kFarthestMoved = 0x1p18F;
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
  bool is_near = true;  ///< so that floats serve
};

class Projector {
 public:
  Projector(const LightSpaceScene& scene, const MapGrid& grid, const LightBounds& light,
            const CasterVolume& volume, std::uint32_t threads)
      : scene_(scene), grid_(grid), volume_(volume), order_(grid), runs_(threads) {
    result_.focus_depth = grid.focus_depth;
    for (std::size_t a = 0; a < 2; ++a)
      reach_[a] = static_cast<float>(std::max(-light.min[a], light.max[a]) / grid.pitch[a]);
  }

  CasterTriangles run(std::size_t triangles) {
    const auto threads = static_cast<int>(runs_.size());
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t n = 0; n < runs_.size(); ++n)
      project_run(runs_[n], triangles * n / runs_.size(), triangles * (n + 1) / runs_.size());
    if (!std::ranges::all_of(runs_, &Run::is_near)) return {};
    resize(number_parts());
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t n = 0; n < runs_.size(); ++n) describe(runs_[n]);
    CasterOrder::sort(keys_);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t chunk = 0; chunk < result_.bounds.size(); ++chunk) fill_chunk(chunk);
    const auto front = std::ranges::partition_point(keys_, CasterOrder::is_front) - keys_.begin();
    result_.front_chunks = chunks_of(static_cast<std::size_t>(front));
    list_large();
    return std::move(result_);
  }

 private:
  /// Projects the casting triangles from `begin` on, before `end`, counted through all meshes.
  void project_run(Run& run, std::size_t begin, std::size_t end) const {
    std::size_t first = 0;
    for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
      const LightSpaceMesh& mesh = scene_.meshes[m];
      if (!mesh.casts) continue;
      const std::size_t last = first + mesh.triangles.size();
      for (std::size_t t = std::max(begin, first); t < std::min(end, last); ++t)
        add_parts(mesh, static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(t - first), run);
      first = last;
    }
  }

  /// What misses all maps leaves no part, a triangle that loses one corner two.
  void add_parts(const LightSpaceMesh& mesh, std::uint32_t mesh_index, std::uint32_t triangle,
                 Run& run) const {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const CasterTriangles::Surface surface{glm::cross(b - a, c - a), mesh_index};
    const CasterPolygon kept = volume_.clip({a, b, c});
    for (std::size_t n = 2; n < static_cast<std::size_t>(kept.count); ++n) {
      Part& part = run.parts.emplace_back(Part{{}, surface, triangle});
      project(kept.corners[0], 0, part.projected);
      project(kept.corners[n - 1], 1, part.projected);
      project(kept.corners[n], 2, part.projected);
      run.is_near = run.is_near && is_near(part.projected);
    }
  }

  void project(const glm::dvec3& p, std::size_t corner, ProjectedTriangle& result) const {
    for (std::size_t a = 0; a < 2; ++a)
      result.g[a][corner] =
          static_cast<float>((p[static_cast<int>(a)] / p.z - grid_.origin[a]) / grid_.pitch[a]);
    result.k[corner] = static_cast<float>(1 / grid_.focus_depth - 1 / p.z);
  }

  /// Whether floats serve, in any sample's map.
  [[nodiscard]] bool is_near(const ProjectedTriangle& triangle) const {
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t n = 0; n < 3; ++n) {
        const float centre = std::abs(triangle.g[a][n]), moved = reach_[a] * std::abs(triangle.k[n]);
        if (!(centre <= kFarthest && moved <= kFarthestMoved)) return false;
      }
    }
    return true;
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

  const LightSpaceScene& scene_;
  const MapGrid& grid_;
  const CasterVolume& volume_;
  const CasterOrder order_;
  std::array<float, 2> reach_{};  // greatest |s| / pitch
  std::vector<Run> runs_;
  std::vector<std::uint64_t> keys_;  // CasterOrder
  CasterTriangles result_;
};

std::size_t count_casters(const LightSpaceScene& scene) {
  std::size_t triangles = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) triangles += mesh.casts ? mesh.triangles.size() : 0;
  return triangles;
}

/// Triangles that some map may hold.
std::size_t count_within(const LightSpaceScene& scene, const CasterVolume& volume) {
  std::size_t triangles = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) {
    if (!mesh.casts) continue;
    for (const glm::uvec3& t : mesh.triangles)
      triangles +=
          volume.clip({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]}).count > 0 ? 1 : 0;
  }
  return triangles;
}

}  // namespace

CasterTriangles project_casters(const LightSpaceScene& scene, const MapGrid& grid, const LightBounds& light,
                                double first_depth, std::uint32_t threads) {
  const CasterVolume volume(grid, light, first_depth);
  double most = kMostPerTexel;
  for (std::size_t a = 0; a < 2; ++a) most *= grid.texels[a] * grid.ratio[a].maps_per_texel();
  const std::size_t triangles = count_casters(scene);
  if (static_cast<double>(triangles) > most && static_cast<double>(count_within(scene, volume)) > most)
    return {};
  return Projector(scene, grid, light, volume, threads).run(triangles);
}

}  // namespace pdsm
