// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "choose/goals.h"
#include "choose/trial.h"

namespace pdsm {

/// Small bakes that differ from the first in one setting each: what that does to error and bytes. `base` has
/// its sampling error measured.
struct StarTrials {
  Trial base;
  Trial more_samples;               ///< kStarSamples times the base's
  Trial finer;                      ///< kStarEdge times the base's texels along each axis
  Trial looser;                     ///< kStarEpsilon times the base's epsilon
  std::optional<Trial> finer_maps;  ///< maps twice as fine; none when their size is given
  /// By how much the look-ups of base and looser differ: the fits alone, whatever else errs.
  double fit_change = 0;
};
inline constexpr double kStarSamples = 2, kStarEdge = 2, kStarEpsilon = 4;

/// Where the star stands: a second of baking on most scenes, less where time is short. `aspect` is the
/// window's width over its height; `maps_given` leaves the maps' size as the options have it.
[[nodiscard]] Settings star_base(const Goals& goals, double aspect, bool maps_given = false);

/// The settings of the other trials.
[[nodiscard]] Settings with_more_samples(const Settings& base);
[[nodiscard]] Settings with_finer_texels(const Settings& base);
[[nodiscard]] Settings with_looser_fit(const Settings& base);
[[nodiscard]] Settings with_finer_maps(const Settings& base);

}  // namespace pdsm
