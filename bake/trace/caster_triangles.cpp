// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_triangles.h"

#include <algorithm>
#include <limits>

#include "trace/caster_order.h"
#include "trace/caster_parts.h"
#include "trace/caster_volume.h"

namespace pdsm {
namespace {

/// More triangles than this for each map texel, and finding them in a BVH takes less than looking at all.
constexpr double kMostPerTexel = 32;
/// Where the triangles lie that only fill a chunk up.
constexpr float kNowhere = -0x1p20F;

/// Slots.
constexpr std::size_t kFetchedAhead = 8;

/// Collects what threads have projected, by id and by slot.
class Collector {
 public:
  CasterTriangles run(const CasterProjector& projector, std::size_t triangles, std::uint32_t thread_count) {
    const auto threads = static_cast<int>(thread_count);
    runs_.resize(thread_count);
    for (CasterRun& run : runs_) {
      run.parts.reserve(triangles / thread_count + 1);
      run.keys.reserve(triangles / thread_count + 1);
    }
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t n = 0; n < runs_.size(); ++n)
      projector.project(triangles * n / runs_.size(), triangles * (n + 1) / runs_.size(), runs_[n]);
    if (!std::ranges::all_of(runs_, &CasterRun::is_near)) return {};
    const std::size_t slots = number_parts();
#pragma omp parallel sections num_threads(threads)
    {
#pragma omp section
      sort_keys(slots);
#pragma omp section
      resize(slots);
    }
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static) nowait
      for (std::size_t n = 0; n < runs_.size(); ++n) list_surfaces(runs_[n]);
#pragma omp for schedule(static)
      for (std::size_t chunk = 0; chunk < result_.bounds.size(); ++chunk) fill_chunk(chunk);
    }
    const auto front = std::ranges::partition_point(keys_, CasterOrder::is_front) - keys_.begin();
    result_.front_chunks = chunks_of(static_cast<std::size_t>(front));
    list_large();
    return std::move(result_);
  }

 private:
  /// Gives ids to all parts, and tells how many there are.
  std::size_t number_parts() {
    std::size_t count = 0;
    for (CasterRun& run : runs_) {
      run.first_id = static_cast<std::uint32_t>(count);
      count += run.parts.size();
    }
    return count;
  }

  [[nodiscard]] const CasterPart& part(std::uint32_t id) const {
    const auto next = std::ranges::upper_bound(runs_, id, {}, &CasterRun::first_id);
    const CasterRun& run = *std::prev(next);
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
  }

  void sort_keys(std::size_t slots) {
    keys_.reserve(slots);
    for (const CasterRun& run : runs_)
      for (const std::uint64_t key : run.keys) keys_.push_back(key + run.first_id);
    CasterOrder::sort(keys_);
  }

  void list_surfaces(const CasterRun& run) {
    for (std::size_t n = 0; n < run.parts.size(); ++n)
      result_.surfaces[run.first_id + n] = run.parts[n].surface;
  }

  void fill_chunk(std::size_t chunk) {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    CasterTriangles::Bounds bounds{{kMost, kMost}, {-kMost, -kMost}, kMost, -kMost};
    const std::size_t first = chunk * CasterTriangles::kChunk,
                      last = std::min(first + CasterTriangles::kChunk, keys_.size());
    for (std::size_t slot = first; slot < last; ++slot) {
      if (slot + kFetchedAhead < last)
        __builtin_prefetch(&part(static_cast<std::uint32_t>(keys_[slot + kFetchedAhead])));
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
      const CasterPart& here = part(result_.ids[slot]);
      if (!here.projected.is_large()) return;
      result_.large.push_back({slot, here.surface.mesh, here.triangle});
    }
  }

  std::vector<CasterRun> runs_;
  std::vector<std::uint64_t> keys_;  // CasterOrder
  CasterTriangles result_;
};

std::size_t count_casters(const LightSpaceScene& scene) {
  std::size_t triangles = 0;
  for (const LightSpaceMesh& mesh : scene.meshes)
    triangles += mesh.is_whole_caster() ? mesh.triangles.size() : 0;
  return triangles;
}

/// Triangles that some map may hold.
std::size_t count_within(const LightSpaceScene& scene, const CasterVolume& volume) {
  std::size_t triangles = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) {
    if (!mesh.is_whole_caster()) continue;
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
  CasterTriangles casters = Collector().run(CasterProjector(scene, grid, light, volume), triangles, threads);
  casters.focus_depth = grid.focus_depth;
  return casters;
}

}  // namespace pdsm
