// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "walk/map_grid.h"

/// The order in which projected triangles are kept, so that those of a chunk lie close together, and what
/// faces the light is entered before what it hides.
namespace pdsm {

/// A triangle's corners in the map of the light's centre: G along each axis, and k.
struct ProjectedTriangle {
  /// Texels along an axis from which on a triangle is large.
  static constexpr float kLargeTexels = 64;

  std::array<std::array<float, 3>, 2> g{};
  std::array<float, 3> k{};

  [[nodiscard]] bool is_large() const;
  /// Whether its front is seen, where fronts look outwards. Nothing but speed depends on that.
  [[nodiscard]] bool faces_light() const;
};

/// Sorts triangles: large ones first, which would widen any chunk; then those that face the light, then all
/// others, each along a curve through the map.
class CasterOrder {
 public:
  explicit CasterOrder(const MapGrid& grid);

  /// Key of triangle `id`, which is its lower half.
  [[nodiscard]] std::uint64_t key(const ProjectedTriangle& triangle, std::uint32_t id) const;
  /// Whether a key's triangle comes before those that don't face the light.
  [[nodiscard]] static bool is_front(std::uint64_t key);
  /// Sorts keys upwards. Their ids must ascend.
  static void sort(std::vector<std::uint64_t>& keys);

 private:
  [[nodiscard]] std::uint32_t cell(const ProjectedTriangle& triangle, std::size_t axis) const;

  std::array<float, 2> first_{}, per_texel_{};  // of cells
};

}  // namespace pdsm
