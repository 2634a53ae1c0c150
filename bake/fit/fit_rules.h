// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Values in the fit are integers: value codes times this, so that all tests are exact.
inline constexpr std::int64_t kValueScale = 256;

/// Ceiling of x >= 0, inline on any target.
[[nodiscard]] inline std::int64_t round_up(double x) {
  const auto whole = static_cast<std::int64_t>(x);
  return whole + (static_cast<double>(whole) < x ? 1 : 0);
}

/// Bounds of the tube in scaled value codes.
struct CountBounds {
  std::int64_t lower = 0, upper = 0;
};

/// What a bake's fits have in common: how vertices are coded, and the tube's bounds for each count.
struct FitRules {
  VertexCoding coding;
  /// Codes of V = 1 that the tube leaves rounding room for: coding.value_max, unless values are unrounded.
  std::uint32_t value_codes = 255;
  std::int64_t code_scale = kValueScale;  ///< scaled values that a written code holds
  std::uint32_t sample_count = 1;  ///< V = count / sample_count; of a mip level: of all its children together
  /// Counts that a light sample holds: of translucent casters' bakes transmittances are rounded to 1 / this,
  /// and level's counts to those of the base.
  std::uint32_t transmittance_unit = 1;
  double epsilon = 0;          ///< bound on V
  double tolerance = 0;        ///< delta, metres, after raising it to what the coding can hold
  double tolerance_codes = 0;  ///< delta in depth codes, >= 1/2
  double near_depth = 0, codes_per_metre = 0;
  bool constant_pieces = false;            ///< lossless: values are counts, pieces are steps
  double half_width = 0, quantum = 0;      ///< scaled value codes: epsilon, and what rounding takes of it
  std::vector<std::int64_t> lower, upper;  ///< bounds_of() each count; empty where there are many

  /// Bounds for V = count / sample_count, quantisation taken off: a line within them stays within epsilon
  /// when its ends are rounded to codes.
  [[nodiscard]] CountBounds bounds_of(std::uint32_t count) const {
    const double value = static_cast<double>(kValueScale) * value_codes * count / sample_count;
    CountBounds bounds{round_up(std::max(value - half_width + quantum, 0.0)),
                       static_cast<std::int64_t>(value + half_width - quantum)};
    bounds.upper = std::min(bounds.upper, kValueScale * std::int64_t{value_codes});
    if (!constant_pieces) return bounds;
    // A constant can only be a whole code.
    return {(bounds.lower + kValueScale - 1) / kValueScale * kValueScale,
            bounds.upper / kValueScale * kValueScale};
  }
  [[nodiscard]] std::int64_t lower_of(std::uint32_t count) const {
    return lower.empty() ? bounds_of(count).lower : lower[count];
  }
  [[nodiscard]] std::int64_t upper_of(std::uint32_t count) const {
    return upper.empty() ? bounds_of(count).upper : upper[count];
  }
  [[nodiscard]] double code_of(float depth) const {
    return (static_cast<double>(depth) - near_depth) * codes_per_metre;
  }
};

/// Chooses the coding that epsilon and delta need, the smallest that serves:
///   values  8 bits while a code is at most a quarter of the tube, else 16; 0 <= epsilon < 4 codes of 16
///           bits: counts of N, exact, as wide as N needs
///   depths  16 bits while two steps are within delta, else 32; no fewer than `least_depth_bits`
[[nodiscard]] FitRules make_fit_rules(const View& view, std::uint32_t sample_count, double epsilon,
                                      double depth_tolerance, std::uint32_t transmittance_unit = 1,
                                      std::uint32_t least_depth_bits = 16);

/// Whether make_fit_rules() makes lossless ones, whose values are counts of light samples.
[[nodiscard]] bool is_lossless(double epsilon);
/// An epsilon that isn't, next to the greatest that is.
inline constexpr double kLeastLossyEpsilon = 3.1e-5;

/// Has values written in scaled values instead of codes: the same tube and pieces, with their ends as the
/// fit has them. Tells what rounding adds. Lossless values are whole codes and stay as they are.
void write_unrounded(FitRules& rules);

/// The rules of a mip level, whose counts are sums over the 4^level texels of each of its own: the same
/// coding and tube. Lossless, a mean of counts is no count: the nearest is within 1 / 2N.
[[nodiscard]] FitRules make_level_rules(const FitRules& rules, std::uint32_t level);

}  // namespace pdsm
