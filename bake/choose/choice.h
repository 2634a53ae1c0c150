// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "choose/goals.h"
#include "choose/laws.h"
#include "choose/settings.h"

namespace pdsm {

/// What settings may at most lead to, by the laws.
struct Limits {
  double error = std::numeric_limits<double>::infinity();
  double bytes = std::numeric_limits<double>::infinity();
  double seconds = std::numeric_limits<double>::infinity();
  double work = std::numeric_limits<double>::infinity();  ///< Settings::work()
  double least_edge = 0;                                  ///< texels, unless they are fixed
  double edge = std::numeric_limits<double>::infinity();  ///< the same, at most
};

/// What may be chosen from.
struct ChoiceSpace {
  FixedOptions fixed;
  Settings given;     ///< values of the fixed ones
  double aspect = 1;  ///< width / height of the window: texels are square
};

/// What is best among the settings that hold all limits.
enum class Wish {
  least_cost,  ///< least cost_of()
  least_error  ///< least error, cost breaking near ties
};

/// Time^2 x bytes, by the laws: a percent of time is worth two of bytes. For comparing alone.
[[nodiscard]] double cost_of(const Laws& laws, const Settings& settings);

/// The best settings within the limits, from all that are practical to tell apart: samples and epsilon in
/// steps of a fifth, edges of 1/16 octave. None when nothing holds the limits. Pure.
[[nodiscard]] std::optional<Settings> choose_settings(const Laws& laws, const ChoiceSpace& space,
                                                      const Limits& limits, Wish wish);

/// The settings of least error within `limits` but for its error, whatever they cost.
[[nodiscard]] std::optional<Settings> most_exact_settings(const Laws& laws, const ChoiceSpace& space,
                                                          Limits limits);

}  // namespace pdsm
