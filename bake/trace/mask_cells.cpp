// SPDX-License-Identifier: Apache-2.0
#include "trace/mask_cells.h"

#include <algorithm>

#include "trace/mask_alpha.h"

namespace pdsm {
namespace {

/// Texels along a cell's edge.
constexpr std::int64_t kCell = 4;
/// Texels: room for places and radii that come out otherwise in other roundings.
constexpr double kRounding = 0x1p-6;

constexpr std::uint8_t kMostAlike = 255;

}  // namespace

MaskCells::MaskCells(const CutoutMask& mask)
    : mask_(mask), columns_((mask.width + kCell - 1) / kCell), rows_((mask.height + kCell - 1) / kCell) {
  cells_.reserve(static_cast<std::size_t>(columns_ * rows_));
  for (std::int64_t y = 0; y < rows_; ++y)
    for (std::int64_t x = 0; x < columns_; ++x) cells_.push_back({part_of(x, y), kMostAlike});
  // Two passes give distances by king's moves (Rosenfeld and Pfaltz 1966): what comes first, then the rest.
  for (std::int64_t y = 0; y < rows_; ++y) {
    for (std::int64_t x = 0; x < columns_; ++x) {
      Cell& cell = cells_[static_cast<std::size_t>(y * columns_ + x)];
      cell.alike = std::min({alike_beside(cell, x - 1, y), alike_beside(cell, x - 1, y - 1),
                             alike_beside(cell, x, y - 1), alike_beside(cell, x + 1, y - 1)});
    }
  }
  for (std::int64_t y = rows_; y-- > 0;) {
    for (std::int64_t x = columns_; x-- > 0;) {
      Cell& cell = cells_[static_cast<std::size_t>(y * columns_ + x)];
      cell.alike = std::min({cell.alike, alike_beside(cell, x + 1, y), alike_beside(cell, x + 1, y + 1),
                             alike_beside(cell, x, y + 1), alike_beside(cell, x - 1, y + 1)});
    }
  }
}

/// Alpha between texels is between theirs, rounded too: mask_alpha.cpp moves from one texel towards the next
/// by no more than their difference. Cells that the border cuts are mixed.
MaskPart MaskCells::part_of(std::int64_t column, std::int64_t row) const {
  const std::int64_t x1 = (column + 1) * kCell, y1 = (row + 1) * kCell;
  if (x1 > mask_.width || y1 > mask_.height) return MaskPart::mixed;
  bool any_solid = false, any_hole = false;
  for (std::int64_t y = y1 - kCell; y < y1; ++y) {
    for (std::int64_t x = x1 - kCell; x < x1; ++x) {
      const bool solid = is_solid_alpha(mask_, mask_.alpha[static_cast<std::size_t>(y * mask_.width + x)]);
      (solid ? any_solid : any_hole) = true;
    }
  }
  if (any_solid && any_hole) return MaskPart::mixed;
  return any_solid ? MaskPart::solid : MaskPart::hole;
}

std::uint8_t MaskCells::alike_beside(const Cell& cell, std::int64_t column, std::int64_t row) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return 0;
  const Cell& beside = cells_[static_cast<std::size_t>(row * columns_ + column)];
  if (cell.part == MaskPart::mixed || beside.part != cell.part) return 0;
  return static_cast<std::uint8_t>(std::min<int>(beside.alike + 1, kMostAlike));
}

MaskPart MaskCells::around(const glm::dvec2& place, double radius) const {
  // In the cell of the lower left of the four texels that are looked at, of which the others are one away.
  const double x = texel_at(place.x, mask_.width, mask_.wrap[0]),
               y = texel_at(place.y, mask_.height, mask_.wrap[1]);
  const auto column = static_cast<std::int64_t>(std::max(x, 0.0)) / kCell,
             row = static_cast<std::int64_t>(std::max(y, 0.0)) / kCell;
  const Cell& cell = cells_[static_cast<std::size_t>(row * columns_ + column)];
  const bool all_alike = radius + 1 + kRounding <= static_cast<double>(cell.alike * kCell);
  return all_alike ? cell.part : MaskPart::mixed;
}

}  // namespace pdsm
