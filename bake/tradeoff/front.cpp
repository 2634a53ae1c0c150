// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/front.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pdsm {

std::vector<bool> pareto_front(std::span<const Choice> choices) {
  std::vector<std::size_t> order(choices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Choice &x = choices[a], &y = choices[b];
    return x.cost != y.cost ? x.cost < y.cost : x.error < y.error;
  });
  // By rising cost, a choice is on the front when nothing before it erred as little; equals stand together.
  std::vector<bool> on_front(choices.size(), false);
  Choice last{0, std::numeric_limits<double>::infinity()};
  for (const std::size_t n : order) {
    const Choice& choice = choices[n];
    const bool equals_last = choice.cost == last.cost && choice.error == last.error;
    if (choice.error >= last.error && !equals_last) continue;
    on_front[n] = true;
    last = choice;
  }
  return on_front;
}

std::size_t best_within(std::span<const Choice> choices, double cost) {
  std::size_t best = choices.size();
  for (std::size_t n = 0; n < choices.size(); ++n) {
    if (choices[n].cost > cost) continue;
    const bool better = best == choices.size() || choices[n].error < choices[best].error ||
                        (choices[n].error == choices[best].error && choices[n].cost < choices[best].cost);
    if (better) best = n;
  }
  return best;
}

}  // namespace pdsm
