// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trace/light_bounds.h"
#include "trace/light_space.h"
#include "walk/map_grid.h"

/// All caster triangles of meshes without holes, projected once for the maps of all light samples.
///
/// A sample s in the light's plane sees the point Q in the texel
///
///   g = (Q_xy / Q_z - origin) / pitch  +  s k / pitch  -  jitter,     k = 1/F - 1/Q_z
///
/// by the shift law (walk/ray_path.h). So a vertex is its place G in the map of the light's centre, and k:
/// one multiplication and one addition an axis move it to any sample's map. 1/z is linear over a projected
/// triangle, and so is k, which grows with depth.
///
/// A triangle, or a part of one, has an id by its place in the scene, and a slot by its place in the map
/// (CasterOrder). Ids decide between equal depths, so that slots are free to be in any order.
namespace pdsm {

struct CasterTriangles {
  /// Triangles that are tested against a map together: a multiple of the lanes of any SIMD.
  static constexpr std::uint32_t kChunk = 64;

  /// What is left of a triangle when it has been met: `normal` is not of unit length.
  struct Surface {
    glm::vec3 normal;
    std::uint32_t mesh = 0;
  };
  /// A triangle that spans so much of a map that it pays to ask whether it matters at all.
  struct Large {
    std::uint32_t slot = 0, mesh = 0, triangle = 0;
  };
  /// Bounds of a chunk's vertices.
  struct Bounds {
    std::array<float, 2> least{}, greatest{};  ///< of G
    float least_k = 0, greatest_k = 0;
  };

  /// Corners' G along each axis, and their k: by corner, then by slot. The last chunk is filled up with
  /// triangles outside of any map.
  std::array<std::array<std::vector<float>, 3>, 2> g;
  std::array<std::vector<float>, 3> k;
  std::vector<std::uint32_t> ids;  ///< by slot
  std::vector<Surface> surfaces;   ///< by id
  std::vector<Bounds> bounds;      ///< one a chunk
  std::uint32_t front_chunks = 0;  ///< chunks that hold what faces the light, the first ones
  std::vector<Large> large;        ///< by slot
  double focus_depth = 0;

  [[nodiscard]] bool empty() const { return surfaces.empty(); }
};

/// Projects the casters without holes of `scene` that some sample's map may hold (CasterVolume); what is
/// nearer than `first_depth` > 0 is cut off. Ids are in the order of meshes and triangles. Empty where it
/// does not pay, or floats don't serve: no casters, many more triangles than texels, or triangles so close to
/// the light that samples see them far apart. Those that no map holds decide nothing.
[[nodiscard]] CasterTriangles project_casters(const LightSpaceScene& scene, const MapGrid& grid,
                                              const LightBounds& light, double first_depth,
                                              std::uint32_t threads);

}  // namespace pdsm
