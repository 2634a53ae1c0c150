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
  rules.constant_pieces = width * 65535 < kLeastTubeCodes;
  if (rules.constant_pieces) {
    rules.coding.value_max = rules.sample_count;
    rules.coding.value_bits = rules.sample_count <= 0xFF ? 8 : rules.sample_count <= 0xFFFF ? 16 : 32;
    return;
  }
  rules.coding.value_bits = width * 255 >= kLeastTubeCodes ? 8 : 16;
  rules.coding.value_max = (1u << rules.coding.value_bits) - 1;
}

void choose_depth_coding(const View& view, double depth_tolerance, FitRules& rules) {
  rules.coding.depth_bits = 16;
  if (depth_tolerance < kLeastToleranceSteps * depth_step(view, rules.coding)) rules.coding.depth_bits = 32;
  const double step = depth_step(view, rules.coding);
  // Any window of 2 delta must hold a code.
  rules.tolerance = std::max(depth_tolerance, step / 2);
  rules.tolerance_codes = std::max(depth_tolerance / step, 0.5);
  rules.near_depth = view.near_depth;
  rules.codes_per_metre = 1 / step;
}

void fill_bounds(FitRules& rules) {
  const double max = rules.coding.value_max, scale = static_cast<double>(kValueScale);
  // Rounding an end to a code moves it by half a code; counts are codes already.
  const double quantum = rules.constant_pieces ? 0 : scale / 2 + kRoundingSlack;
  rules.lower.resize(std::size_t{rules.sample_count} + 1);
  rules.upper.resize(std::size_t{rules.sample_count} + 1);
  for (std::uint32_t count = 0; count <= rules.sample_count; ++count) {
    const double value = scale * max * count / rules.sample_count, width = scale * max * rules.epsilon;
    const auto low = static_cast<std::int64_t>(std::ceil(value - width + quantum));
    const auto high = static_cast<std::int64_t>(std::floor(value + width - quantum));
    rules.lower[count] = std::max<std::int64_t>(low, 0);
    rules.upper[count] = std::min<std::int64_t>(high, kValueScale * std::int64_t{rules.coding.value_max});
    if (!rules.constant_pieces) continue;
    // A constant can only be a whole code.
    rules.lower[count] = (rules.lower[count] + kValueScale - 1) / kValueScale * kValueScale;
    rules.upper[count] = rules.upper[count] / kValueScale * kValueScale;
  }
}

}  // namespace

FitRules make_fit_rules(const View& view, std::uint32_t sample_count, double epsilon,
                        double depth_tolerance) {
  FitRules rules;
  rules.sample_count = sample_count;
  rules.epsilon = epsilon;
  choose_value_coding(rules);
  choose_depth_coding(view, depth_tolerance, rules);
  fill_bounds(rules);
  return rules;
}

}  // namespace pdsm
