// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace pdsm {

/// A choice with two costs, both better when smaller.
struct Choice {
  double cost = 0;   ///< seconds or bytes
  double error = 0;  ///< mean absolute error
};

/// Whether `a` is as good as `b` in both, and better in one.
[[nodiscard]] constexpr bool dominates(const Choice& a, const Choice& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

/// The Pareto front: for each choice, whether no other dominates it. Equal choices are in it together.
/// O(n log n); NaN is not allowed.
[[nodiscard]] std::vector<bool> pareto_front(std::span<const Choice> choices);

/// Index of the choice of the least error among those whose cost is at most `cost`; `choices.size()` when
/// there is none. Of equals the cheapest, then the first.
[[nodiscard]] std::size_t best_within(std::span<const Choice> choices, double cost);

}  // namespace pdsm
