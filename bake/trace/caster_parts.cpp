// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_parts.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// Texels beside the map's lower corner. An edge function's rounding moves an edge by less than 2^-24 times
/// four such lengths: 1/128 of a texel, in the worst case.
constexpr float kFarthest = 0x1p15F;
/// The same in any sample's map: 1/16 of a texel, for what is so close to the light that it hides half of it.
constexpr float kFarthestMoved = 0x1p18F;

}  // namespace

CasterProjector::CasterProjector(const LightSpaceScene& scene, const MapGrid& grid, const LightBounds& light,
                                 const CasterVolume& volume)
    : scene_(scene), grid_(grid), volume_(volume), order_(grid) {
  for (std::size_t a = 0; a < 2; ++a)
    reach_[a] = static_cast<float>(std::max(-light.min[a], light.max[a]) / grid.pitch[a]);
}

void CasterProjector::project(std::size_t begin, std::size_t end, CasterRun& run) const {
  std::size_t first = 0;
  for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
    const LightSpaceMesh& mesh = scene_.meshes[m];
    if (!mesh.is_whole_caster()) continue;
    const std::size_t last = first + mesh.triangles.size();
    for (std::size_t t = std::max(begin, first); t < std::min(end, last); ++t)
      add_parts(mesh, static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(t - first), run);
    first = last;
  }
}

/// What misses all maps leaves no part, a triangle that loses one corner two.
void CasterProjector::add_parts(const LightSpaceMesh& mesh, std::uint32_t mesh_index, std::uint32_t triangle,
                                CasterRun& run) const {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
  const CasterTriangles::Surface surface{glm::cross(b - a, c - a), mesh_index};
  const std::array<glm::dvec3, 3> whole{a, b, c};
  if (volume_.holds(whole)) {
    add_part(whole, surface, triangle, run);
    return;
  }
  const CasterPolygon kept = volume_.clip(whole);
  for (std::size_t n = 2; n < static_cast<std::size_t>(kept.count); ++n)
    add_part({kept.corners[0], kept.corners[n - 1], kept.corners[n]}, surface, triangle, run);
}

void CasterProjector::add_part(const std::array<glm::dvec3, 3>& corners,
                               const CasterTriangles::Surface& surface, std::uint32_t triangle,
                               CasterRun& run) const {
  const CasterPart part{project(corners), surface, triangle};
  run.is_near = run.is_near && is_near(part.projected);
  run.keys.push_back(order_.key(part.projected, static_cast<std::uint32_t>(run.parts.size())));
  run.parts.push_back(part);
}

ProjectedTriangle CasterProjector::project(const std::array<glm::dvec3, 3>& corners) const {
  ProjectedTriangle result;
  for (std::size_t n = 0; n < 3; ++n) {
    const glm::dvec3& p = corners[n];
    for (std::size_t a = 0; a < 2; ++a)
      result.g[a][n] = static_cast<float>((p[static_cast<int>(a)] / p.z - grid_.origin[a]) / grid_.pitch[a]);
    result.k[n] = static_cast<float>(1 / grid_.focus_depth - 1 / p.z);
  }
  return result;
}

bool CasterProjector::is_near(const ProjectedTriangle& triangle) const {
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t n = 0; n < 3; ++n) {
      const float centre = std::abs(triangle.g[a][n]), moved = reach_[a] * std::abs(triangle.k[n]);
      if (!(centre <= kFarthest && moved <= kFarthestMoved)) return false;
    }
  }
  return true;
}

}  // namespace pdsm
