// SPDX-License-Identifier: Apache-2.0
#include "choose/choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pdsm {
namespace {

/// Ends of what is chosen from. Fewer than 64 samples and wider tubes than 0.05 show as bands and blotches,
/// however small their mean error, and take more room than they save; no map below 16 texels is of use; below
/// the least epsilon hardly any error is the fit's.
constexpr double kLeastSamples = 64, kMostSamples = 65536;
constexpr double kLeastEdge = 16, kMostEdge = 16384;
constexpr double kLeastEpsilon = 5e-4, kMostEpsilon = 0.05;
constexpr double kStepsPerOctave = 4, kEdgeStepsPerOctave = 16;
/// Widths and heights are multiples of this.
constexpr std::uint32_t kTexelStep = 8;
/// With Wish::least_error, a percent less error is worth this many percent of time, and of bytes: budgets are
/// used, but neither samples nor the fit are driven to where they hardly count.
constexpr double kPercentOfTime = 40, kPercentOfBytes = 13;

/// low, ..., high in geometric steps.
std::vector<double> ladder(double low, double high, double steps_per_octave) {
  std::vector<double> values;
  const double steps = std::floor(std::log2(high / low) * steps_per_octave);
  for (double n = 0; n <= steps; ++n) values.push_back(low * std::exp2(n / steps_per_octave));
  return values;
}

std::uint32_t to_texels(double n) {
  const double steps = std::max(1.0, std::round(n / kTexelStep));
  return std::min(static_cast<std::uint32_t>(steps) * kTexelStep, static_cast<std::uint32_t>(kMostEdge));
}

std::vector<std::array<std::uint32_t, 2>> sizes(const ChoiceSpace& space, const Limits& limits) {
  if (space.fixed.resolution) return {{space.given.width, space.given.height}};
  std::vector<std::array<std::uint32_t, 2>> list;
  const double root = std::sqrt(space.aspect);
  for (const double edge : ladder(kLeastEdge, kMostEdge, kEdgeStepsPerOctave)) {
    if (edge < limits.least_edge || edge > limits.edge) continue;
    list.push_back({to_texels(edge * root), to_texels(edge / root)});
  }
  return list;
}

std::vector<std::uint32_t> sample_counts(const ChoiceSpace& space) {
  if (space.fixed.samples) return {space.given.samples};
  std::vector<std::uint32_t> list;
  for (const double n : ladder(kLeastSamples, kMostSamples, kStepsPerOctave)) {
    list.push_back(static_cast<std::uint32_t>(std::lround(n)));
  }
  return list;
}

std::vector<double> epsilons(const ChoiceSpace& space) {
  if (space.fixed.epsilon) return {space.given.epsilon};
  std::vector<double> list = ladder(kLeastEpsilon, kMostEpsilon, kStepsPerOctave);
  // Three digits are all that anyone would give, and survive every way of writing them.
  for (double& epsilon : list) epsilon = std::round(epsilon * 1e4) / 1e4;
  return list;
}

std::vector<std::uint32_t> maps_per_texel(const ChoiceSpace& space, std::uint32_t texels) {
  if (space.fixed.map_resolution) return {space.given.maps_per_texel};
  if (2 * texels > kMostEdge) return {1};
  return {1, 2};
}

/// Calls `visit` with each setting whose error holds its limit, and that error, in a fixed order.
template <typename Visit>
void for_each_setting(const Laws& laws, const ChoiceSpace& space, const Limits& limits, const Visit& visit) {
  const std::vector<std::uint32_t> counts = sample_counts(space);
  const std::vector<double> fits = epsilons(space);
  // Of sampling and fit together, for all sizes.
  std::vector<double> penumbra;
  for (const std::uint32_t samples : counts) {
    for (const double epsilon : fits)
      penumbra.push_back(std::hypot(laws.sampling_error(samples), laws.fit_error(epsilon)));
  }
  for (const auto& [width, height] : sizes(space, limits)) {
    for (const std::uint32_t maps : maps_per_texel(space, std::max(width, height))) {
      Settings s{0, width, height, 0, maps};
      const double resolution = laws.resolution_error(s.edge(), maps);
      for (std::size_t n = 0; n < penumbra.size(); ++n) {
        const double error = resolution + penumbra[n];
        if (error > limits.error) continue;
        s.samples = counts[n / fits.size()];
        s.epsilon = fits[n % fits.size()];
        visit(s, error);
      }
    }
  }
}

/// The setting of least `cost`, of itself and its error, that holds the limits.
template <typename Cost>
std::optional<Settings> cheapest(const Laws& laws, const ChoiceSpace& space, const Limits& limits,
                                 const Cost& cost) {
  std::optional<Settings> best;
  double least = 0;
  for_each_setting(laws, space, limits, [&](const Settings& s, double error) {
    const double c = cost(s, error);
    if (best && c >= least) return;
    if (s.work() > limits.work) return;
    if (laws.bytes(s) > limits.bytes || laws.seconds(s) > limits.seconds) return;
    best = s;
    least = c;
  });
  return best;
}

/// What Wish::least_error minimises.
double error_with_cost(const Laws& laws, const Settings& s, double error) {
  constexpr double kNoError = 1e-9;
  return std::log(std::max(kNoError, error)) + std::log(s.work()) / kPercentOfTime +
         std::log(laws.bytes(s)) / kPercentOfBytes;
}

}  // namespace

double cost_of(const Laws& laws, const Settings& settings) {
  return settings.work() * settings.work() * laws.bytes(settings);
}

std::optional<Settings> choose_settings(const Laws& laws, const ChoiceSpace& space, const Limits& limits,
                                        Wish wish) {
  return cheapest(laws, space, limits, [&](const Settings& s, double error) {
    return wish == Wish::least_cost ? std::log(cost_of(laws, s)) : error_with_cost(laws, s, error);
  });
}

std::optional<Settings> most_exact_settings(const Laws& laws, const ChoiceSpace& space, Limits limits) {
  limits.error = std::numeric_limits<double>::infinity();
  return cheapest(laws, space, limits, [](const Settings&, double error) { return error; });
}

}  // namespace pdsm
