// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "choose/choice.h"

namespace pdsm {

/// Why no settings hold the goals, by the laws: one line "--goal: reason" that names the goal in the way.
/// `limits.error` is infinite unless an error is asked for.
[[nodiscard]] std::string explain_shortfall(const Laws& laws, const ChoiceSpace& space, const Goals& goals,
                                            const Limits& limits);

/// The line for a target that the tries came near, but did not reach.
[[nodiscard]] std::string explain_miss(const Goals& goals, std::span<const Trial> tries);

}  // namespace pdsm
