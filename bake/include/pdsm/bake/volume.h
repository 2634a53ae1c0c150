// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

/// Volumes of a scene (scene.h): smoke, clouds, fog. Plain data, as meshes are; read from OpenVDB files by
/// read_scene(), or filled by a host program.
namespace pdsm {

/// Densities at the 8 x 8 x 8 lattice points from `first` on.
struct DensityBrick {
  static constexpr std::int32_t kEdge = 8;

  glm::ivec3 first{0};  ///< multiples of 8
  std::array<float, 512> density{};

  /// Where the point `first` + (x, y, z) is.
  [[nodiscard]] static constexpr std::size_t at(int x, int y, int z) {
    return static_cast<std::size_t>((z * kEdge + y) * kEdge + x);
  }
};

/// A sparse density: trilinear between lattice points, 0 at those that no brick has.
struct DensityGrid {
  std::vector<DensityBrick> bricks;  ///< ordered by first.z, then y, then x; each place once
};
/// Bricks that a grid may have, and that may fit the box around them: 2 GiB of densities, 256 MiB of places.
inline constexpr std::size_t kMostBricks = std::size_t{1} << 20, kMostBrickPlaces = std::size_t{1} << 26;
/// Coordinates of lattice points, which a float tells apart with room for their halves.
inline constexpr std::int32_t kMostLatticeCoordinate = 1 << 22;

/// One placed density. It takes light away, and receives nothing. Where volumes overlap, they add.
struct Volume {
  std::string name;  ///< file:grid, for messages
  std::shared_ptr<const DensityGrid> grid;
  glm::dmat4 index_to_world{1.0};  ///< of lattice coordinates; affine, not singular
  /// Share of light lost per metre of the world at density 1, for thin layers: a ray keeps
  /// exp(-extinction x integral of density along it). 0 or more.
  double extinction = 1;
  bool casts = true;
};

/// Throws Error (input) "name:field: reason" for a volume that is not as described above. Baking calls it.
/// O(lattice points).
void check_volume(const Volume& volume);

/// Whether a volume takes any light away.
[[nodiscard]] inline bool casts_shadows(const Volume& volume) {
  return volume.casts && volume.extinction > 0 && volume.grid && !volume.grid->bricks.empty();
}

}  // namespace pdsm
