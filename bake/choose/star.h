// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "choose/goals.h"
#include "choose/trial.h"

namespace pdsm {

/// Four small bakes that differ in one setting each: what each setting does to error and bytes.
struct StarTrials {
  Trial base;
  Trial more_samples;  ///< kStarSamples times the base's
  Trial finer;         ///< kStarEdge times the base's texels along each axis
  Trial looser;        ///< kStarEpsilon times the base's epsilon
};
inline constexpr double kStarSamples = 4, kStarEdge = 2, kStarEpsilon = 4;

/// Where the star stands: a second of baking on most scenes, less where time is short. `aspect` is the
/// window's width over its height.
[[nodiscard]] Settings star_base(const Goals& goals, double aspect);

/// The settings of the other trials.
[[nodiscard]] Settings with_more_samples(const Settings& base);
[[nodiscard]] Settings with_finer_texels(const Settings& base);
[[nodiscard]] Settings with_looser_fit(const Settings& base);

}  // namespace pdsm
