// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// A vertex as the GPU has it: 16 bytes.
struct SurfaceVertex {
  glm::vec3 position;        ///< metres from the origin
  std::uint32_t normal = 0;  ///< signed 10 bits each, x lowest

  friend bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};

/// Indexed triangles.
struct SurfaceMesh {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Packs a vector of at most unit length.
[[nodiscard]] std::uint32_t pack_normal(const glm::vec3& normal);

/// A placed mesh with smooth normals, relative to `origin` (world, metres). Triangles with corners that are
/// not finite are left out.
[[nodiscard]] SurfaceMesh make_surface_mesh(const Geometry& geometry, const glm::dvec3& origin);

/// A trefoil knot about the origin, within a sphere of radius 1.2.
[[nodiscard]] SurfaceMesh make_knot();

}  // namespace pdsm
