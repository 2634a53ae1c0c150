// SPDX-License-Identifier: Apache-2.0
#include "choose/star.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// Fine enough that the laws hold from there on.
constexpr std::uint32_t kBaseSamples = 64;
constexpr double kBaseEdge = 256;
/// Where time is short: an eighth of the work.
constexpr std::uint32_t kHastySamples = 32;
constexpr double kHastyEdge = 128;
/// About the epsilon that a target leads to, and of use where there is none.
constexpr double kBaseEpsilon = 0.01, kLeastEpsilon = 0.004, kMostEpsilon = 0.04;

std::uint32_t whole(double n) {
  return static_cast<std::uint32_t>(std::max(1L, std::lround(n)));
}

}  // namespace

Settings star_base(const Goals& goals, double aspect, bool maps_given) {
  const double edge = goals.time_budget ? kHastyEdge : kBaseEdge, root = std::sqrt(aspect);
  Settings base;
  base.samples = goals.time_budget ? kHastySamples : kBaseSamples;
  base.width = whole(edge * root);
  base.height = whole(edge / root);
  base.epsilon = std::clamp(goals.target_error.value_or(kBaseEpsilon), kLeastEpsilon, kMostEpsilon);
  base.maps_per_texel = maps_given ? 0 : 1;
  return base;
}

Settings with_more_samples(const Settings& base) {
  Settings settings = base;
  settings.samples = whole(base.samples * kStarSamples);
  return settings;
}

Settings with_finer_texels(const Settings& base) {
  Settings settings = base;
  settings.width = whole(base.width * kStarEdge);
  settings.height = whole(base.height * kStarEdge);
  return settings;
}

Settings with_looser_fit(const Settings& base) {
  Settings settings = base;
  settings.epsilon = base.epsilon * kStarEpsilon;
  return settings;
}

Settings with_finer_maps(const Settings& base) {
  Settings settings = base;
  settings.maps_per_texel = 2;
  return settings;
}

}  // namespace pdsm
