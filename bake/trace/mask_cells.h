// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What is the same all around a place of a mask.
enum class MaskPart : std::uint8_t { mixed, solid, hole };

/// How far around each place of a mask nothing changes, in cells of a few texels: answers for whole
/// footprints at once, and from little memory. Borrows the mask. After construction any thread.
class MaskCells {
 public:
  explicit MaskCells(const CutoutMask& mask);

  /// Solid or hole where is_solid() (mask_alpha.h) has that answer at all places within `radius` texels of
  /// the mask, along each axis, of `place` (u, v), which is finite; mixed where it may have both. Borders of
  /// the mask count as changes.
  [[nodiscard]] MaskPart around(const glm::dvec2& place, double radius) const;

 private:
  struct Cell {
    MaskPart part = MaskPart::mixed;
    std::uint8_t alike = 0;  ///< this many cells around this one, and diagonally, are of its part
  };

  [[nodiscard]] MaskPart part_of(std::int64_t column, std::int64_t row) const;
  /// What `cell`'s `alike` may be at most, next to the one at (column, row), which may lie beyond the border.
  [[nodiscard]] std::uint8_t alike_beside(const Cell& cell, std::int64_t column, std::int64_t row) const;

  const CutoutMask& mask_;
  std::int64_t columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace pdsm
