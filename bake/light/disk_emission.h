// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pdsm/bake/scene.h"

/// Pictures of disk lights cover the disk's bounding square; what lies on the disk emits. Coordinates are of
/// the unit disk, in [-1, 1].
namespace pdsm {

/// Share of a texel of the picture that lies on the light, 0 .. 1: all of it for a rect.
[[nodiscard]] double share_on_light(const Light& light, std::uint32_t column, std::uint32_t row);

/// What EmissionWarp is for squares: moves the points of the unit square to the unit disk so that as many lie
/// in a region as it emits of the whole, exactly so in the texels that the rim cuts. Heights first, then
/// along the chord; monotone along both. Some texel must emit on the disk.
class DiskEmissionWarp {
 public:
  explicit DiskEmissionWarp(const EmissionImage& image);

  /// `unit` in [0, 1)². O(log height + width).
  [[nodiscard]] std::array<double, 2> operator()(const std::array<double, 2>& unit) const;

 private:
  /// What emits between the heights y0 and y1, within one row.
  [[nodiscard]] double emitted(std::size_t row, double y0, double y1) const;
  [[nodiscard]] double height_at(std::size_t row, double wanted) const;
  /// Where a row begins to emit, seen from the axis.
  [[nodiscard]] double innermost_x(std::size_t row) const;
  [[nodiscard]] double along_chord(std::size_t row, double y, double unit) const;
  [[nodiscard]] double edge_x(std::size_t column) const;
  [[nodiscard]] double edge_y(std::size_t row) const;

  EmissionImage image_;
  std::vector<double> before_;  ///< what the rows before emit, height + 1
};

}  // namespace pdsm
