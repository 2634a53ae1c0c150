// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "choose/choice.h"
#include "choose/goals.h"
#include "choose/trial.h"

namespace pdsm {

/// What a search has seen so far, and the room that it leaves for what comes next.
class TrialRecord {
 public:
  /// The laws are trusted up to this factor in edge beyond the largest trial, and below the smallest.
  static constexpr double kTrustedStep = 3;

  void note(const Trial& trial);
  /// The same for a bake that was meant to be the result.
  void note_try(const Trial& trial);

  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }  ///< all, in order
  [[nodiscard]] const std::vector<Trial>& tries() const { return tries_; }
  [[nodiscard]] double largest_edge() const { return largest_edge_; }  ///< texels
  [[nodiscard]] double largest_work() const { return largest_work_; }
  [[nodiscard]] bool was_tried(const Settings& settings) const;

  /// What the next bake has to stay within. At least one trial has been noted.
  [[nodiscard]] Limits limits(const Goals& goals) const;
  /// Of a time budget, for one more bake that is measured as the last one.
  [[nodiscard]] double seconds_left(double time_budget) const;

 private:
  std::vector<Trial> trials_, tries_;
  double smallest_edge_ = std::numeric_limits<double>::infinity();
  double largest_edge_ = 0, largest_work_ = 0;
};

}  // namespace pdsm
