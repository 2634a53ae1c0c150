// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Values in the fit are integers: value codes times this, so that all tests are exact.
inline constexpr std::int64_t kValueScale = 256;

/// What a bake's fits have in common: how vertices are coded, and the tube's bounds for each count.
struct FitRules {
  VertexCoding coding;
  std::uint32_t sample_count = 1;
  double epsilon = 0;          ///< bound on V
  double tolerance = 0;        ///< delta, metres, after raising it to what the coding can hold
  double tolerance_codes = 0;  ///< delta in depth codes, >= 1/2
  double near_depth = 0, codes_per_metre = 0;
  bool constant_pieces = false;  ///< lossless: values are counts, pieces are steps
  /// Bounds in scaled value codes for V = count / N, quantisation taken off: a line within them stays
  /// within epsilon when its ends are rounded to codes.
  std::vector<std::int64_t> lower, upper;

  [[nodiscard]] double code_of(float depth) const {
    return (static_cast<double>(depth) - near_depth) * codes_per_metre;
  }
};

/// Chooses the coding that epsilon and delta need, the smallest that serves:
///   values  8 bits while a code is at most a quarter of the tube, else 16; 0 <= epsilon < 4 codes of 16
///           bits: counts of N, exact, as wide as N needs
///   depths  16 bits while two steps are within delta, else 32
[[nodiscard]] FitRules make_fit_rules(const View& view, std::uint32_t sample_count, double epsilon,
                                      double depth_tolerance);

}  // namespace pdsm
