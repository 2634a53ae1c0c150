// SPDX-License-Identifier: Apache-2.0
#include "choose/trial_record.h"

#include <algorithm>
#include <cmath>

#include "choose/search.h"
#include "choose/verdict.h"

namespace pdsm {
namespace {

/// From try to try, the edge shrinks by this factor at most: where resolution is hardly any of the error, the
/// laws do not tell where it begins to be.
constexpr double kNextStep = 1.5;
/// From try to try the aim shrinks, so that tries that err come to an end.
constexpr double kNextAim = 0.95;
/// Shares of a size and of a time budget that are aimed at.
constexpr double kSizeAim = 0.95, kTimeAim = 0.85;

}  // namespace

void TrialRecord::note(const Trial& trial) {
  trials_.push_back(trial);
  smallest_edge_ = std::min(smallest_edge_, trial.settings.edge());
  largest_edge_ = std::max(largest_edge_, trial.settings.edge());
  largest_work_ = std::max(largest_work_, trial.settings.work());
}

void TrialRecord::note_try(const Trial& trial) {
  note(trial);
  tries_.push_back(trial);
}

bool TrialRecord::was_tried(const Settings& settings) const {
  return std::any_of(tries_.begin(), tries_.end(),
                     [&](const Trial& trial) { return trial.settings == settings; });
}

Limits TrialRecord::limits(const Goals& goals) const {
  Limits limits;
  if (goals.target_error) {
    const auto misses = static_cast<double>(tries_.size());
    limits.error = std::pow(kNextAim, misses) * aim_for(*goals.target_error, trials_.back());
  }
  if (goals.size_budget) {
    const double room = static_cast<double>(*goals.size_budget) - static_cast<double>(kMetadataBytes);
    limits.bytes = kSizeAim * room;
  }
  if (goals.time_budget) limits.seconds = seconds_left(*goals.time_budget);
  limits.work = goals.time_budget ? std::numeric_limits<double>::infinity() : kMostWork;
  limits.least_edge =
      tries_.empty() ? smallest_edge_ / kTrustedStep : tries_.back().settings.edge() / kNextStep;
  return limits;
}

double TrialRecord::seconds_left(double time_budget) const {
  double spent = 0;
  for (const Trial& trial : trials_) spent += trial.seconds();
  return kTimeAim * time_budget - spent - trials_.back().seconds_measure;
}

}  // namespace pdsm
