// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Moves the points of the unit square so that as many lie in a region of a light's picture as it emits of
/// the whole: the samples of a light that is not the same everywhere then have equal weights. Rows first,
/// then along the row; monotone along both, so that what was stratified remains so.
class EmissionWarp {
 public:
  explicit EmissionWarp(const EmissionImage& image);

  /// `unit` in [0, 1)², u along the light's x.
  [[nodiscard]] std::array<double, 2> operator()(const std::array<double, 2>& unit) const;

 private:
  std::uint32_t width_, height_;
  std::vector<double> rows_;     ///< sums of the rows before, height + 1
  std::vector<double> columns_;  ///< sums within each row before, (width + 1) a row
};

}  // namespace pdsm
