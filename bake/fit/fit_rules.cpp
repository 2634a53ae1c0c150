// SPDX-License-Identifier: Apache-2.0
#include "fit/fit_rules.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// A tube narrower than this many codes would lose too much of itself to quantisation.
constexpr double kLeastTubeCodes = 4;
/// delta must hold this many depth steps for the short code.
constexpr double kLeastToleranceSteps = 2;
/// Slack, in scaled codes, for the rounding of a line's ends in double.
constexpr double kRoundingSlack = 1;

void choose_value_coding(FitRules& rules) {
  const double width = 2 * rules.epsilon;
  rules.constant_pieces = is_lossless(rules.epsilon);
  if (rules.constant_pieces) {
    rules.coding.value_max = rules.sample_count;
    rules.coding.value_bits = rules.sample_count <= 0xFF ? 8 : rules.sample_count <= 0xFFFF ? 16 : 32;
    return;
  }
  rules.coding.value_bits = width * 255 >= kLeastTubeCodes ? 8 : 16;
  rules.coding.value_max = (1u << rules.coding.value_bits) - 1;
}

void choose_depth_coding(const View& view, double depth_tolerance, std::uint32_t least_bits,
                         FitRules& rules) {
  rules.coding.depth_bits = least_bits;
  if (depth_tolerance < kLeastToleranceSteps * depth_step(view, rules.coding)) rules.coding.depth_bits = 32;
  const double step = depth_step(view, rules.coding);
  // Any window of 2 delta must hold a code.
  rules.tolerance = std::max(depth_tolerance, step / 2);
  rules.tolerance_codes = std::max(depth_tolerance / step, 0.5);
  rules.near_depth = view.near_depth;
  rules.codes_per_metre = 1 / step;
}

void choose_bounds(FitRules& rules) {
  const auto scale = static_cast<double>(kValueScale);
  rules.half_width = scale * rules.value_codes * rules.epsilon;
  rules.quantum = scale / 2 + kRoundingSlack;
  if (rules.transmittance_unit > 1)
    rules.quantum += scale * rules.value_codes / (2.0 * rules.transmittance_unit);
  if (!rules.constant_pieces) return;
  // Counts are codes already; what lies between two has the nearest.
  rules.half_width = std::max(rules.half_width, scale / 2);
  rules.quantum = 0;
}

void fill_tables(FitRules& rules) {
  for (std::uint32_t count = 0; count <= rules.sample_count; ++count) {
    const CountBounds bounds = rules.bounds_of(count);
    rules.lower.push_back(bounds.lower);
    rules.upper.push_back(bounds.upper);
  }
}

}  // namespace

bool is_lossless(double epsilon) {
  return 2 * epsilon * 65535 < kLeastTubeCodes;
}

FitRules make_fit_rules(const View& view, std::uint32_t sample_count, double epsilon, double depth_tolerance,
                        std::uint32_t transmittance_unit, std::uint32_t least_depth_bits) {
  FitRules rules;
  rules.sample_count = sample_count * transmittance_unit;
  rules.transmittance_unit = transmittance_unit;
  rules.epsilon = epsilon;
  choose_value_coding(rules);
  rules.value_codes = rules.coding.value_max;
  choose_depth_coding(view, depth_tolerance, least_depth_bits, rules);
  choose_bounds(rules);
  if (transmittance_unit == 1) fill_tables(rules);
  return rules;
}

void write_unrounded(FitRules& rules) {
  if (rules.constant_pieces) return;
  rules.code_scale = 1;
  rules.coding.value_max = static_cast<std::uint32_t>(kValueScale) * rules.value_codes;
  rules.coding.value_bits = 2 * rules.coding.value_bits;
}

FitRules make_level_rules(const FitRules& rules, std::uint32_t level) {
  FitRules of_level = rules;
  // Sums of transmittances are scaled down to the base's unit.
  if (rules.transmittance_unit > 1) return of_level;
  of_level.sample_count = rules.sample_count << (2 * level);
  // Tables of 4^6 N counts would take gigabytes.
  of_level.lower.clear();
  of_level.upper.clear();
  return of_level;
}

}  // namespace pdsm
