// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "choose/goals.h"
#include "choose/search.h"

namespace pdsm {

/// Whether a map's file fits the size budget, metadata included.
[[nodiscard]] bool fits_size(const Goals& goals, const Trial& trial);

/// The best of the maps that hold the goals, as tries come in. One map is kept.
class BestBake {
 public:
  /// Whether a try would be kept: it holds the goals, better than what is here.
  [[nodiscard]] bool wants(const Goals& goals, const Trial& trial) const;
  void keep(ChosenBake&& bake) { best_ = std::move(bake); }
  /// Nothing when no try held the goals. Empties this.
  [[nodiscard]] std::optional<ChosenBake> take() { return std::move(best_); }

 private:
  std::optional<ChosenBake> best_;
};

}  // namespace pdsm
