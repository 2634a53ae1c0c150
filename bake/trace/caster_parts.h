// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trace/caster_order.h"
#include "trace/caster_triangles.h"
#include "trace/caster_volume.h"

/// Projected casters before they have slots.
namespace pdsm {

/// A triangle, or what is left of one: one cache line, as parts are fetched in the order of slots.
struct alignas(64) CasterPart {
  ProjectedTriangle projected;
  CasterTriangles::Surface surface;
  std::uint32_t triangle = 0;
};

/// Parts of a run of the scene's casters.
struct CasterRun {
  std::vector<CasterPart> parts;
  std::vector<std::uint64_t> keys;  ///< CasterOrder; ids count from the run's first
  std::uint32_t first_id = 0;
  bool is_near = true;  ///< so that floats serve
};

/// Projects casters for the maps of all samples in `light`.
class CasterProjector {
 public:
  /// Borrows its arguments.
  CasterProjector(const LightSpaceScene& scene, const MapGrid& grid, const LightBounds& light,
                  const CasterVolume& volume);

  /// Projects the casting triangles from `begin` on, before `end`, counted through all meshes. Any thread.
  void project(std::size_t begin, std::size_t end, CasterRun& run) const;

 private:
  void add_parts(const LightSpaceMesh& mesh, std::uint32_t mesh_index, std::uint32_t triangle,
                 CasterRun& run) const;
  void add_part(const std::array<glm::dvec3, 3>& corners, const CasterTriangles::Surface& surface,
                std::uint32_t triangle, CasterRun& run) const;
  [[nodiscard]] ProjectedTriangle project(const std::array<glm::dvec3, 3>& corners) const;
  /// Whether floats serve, in any sample's map.
  [[nodiscard]] bool is_near(const ProjectedTriangle& triangle) const;

  const LightSpaceScene& scene_;
  const MapGrid& grid_;
  const CasterVolume& volume_;
  const CasterOrder order_;
  std::array<float, 2> reach_{};  // greatest |s| / pitch
};

}  // namespace pdsm
