// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "choose/choice.h"
#include "choose/goals.h"
#include "choose/trial.h"

namespace pdsm {

/// A bake that reaches its goals.
struct ChosenBake {
  BakedMap baked;
  Goals goals;                ///< that it was chosen for
  BakeOptions options;        ///< as baked
  Trial chosen;               ///< this bake, measured at points that had no part in choosing it
  VerifyOptions measured_by;  ///< how
  std::vector<Trial> trials;  ///< all, in order; the chosen one is among them
  std::string why;            ///< one clause
  double expected_error = 0, expected_seconds = 0;  ///< of the chosen bake, before it was made
};

/// What search() is asked.
struct SearchTask {
  BakeOptions options;  ///< everything that goals do not choose
  FixedOptions fixed;   ///< which options are kept too
  Goals goals;          ///< at least one
  double aspect = 1;    ///< width / height of the window
};

/// Bakes a light with settings, and measures it.
using RunTrial = std::function<TrialBake(const std::string& purpose, const Settings& settings,
                                         const VerifyOptions& measure, TrialAim aim)>;

/// What choose_bake() does, with any way to bake.
[[nodiscard]] ChosenBake search(const SearchTask& task, const RunTrial& run);

/// Bakes `light` so that the goals hold, with `options` for everything that goals do not choose; `fixed` of
/// the rest are kept too. At least one goal.
///
/// Small trials tell how sampling, resolution and fit share the error, and what each costs (laws.h). The
/// best settings by that are baked and measured at new points; what is found corrects the laws, until the
/// goals hold: a few tries at most. For error and size the result depends on the arguments and the ISA alone;
/// a time budget looks at the clock.
///
/// Throws GoalMissed when the goals can't be reached, else as bake() does.
[[nodiscard]] ChosenBake choose_bake(const Scene& scene, const Light& light, const BakeOptions& options,
                                     const FixedOptions& fixed, const Goals& goals,
                                     const TrialCallbacks& callbacks = {});

/// Samples x map texels beyond which no bake goes unless a time budget allows it: ten minutes on two cores.
inline constexpr double kMostWork = 1e10;

/// Bytes of a file that goals set aside for its metadata: these take some 1,100.
inline constexpr std::uint64_t kMetadataBytes = 2048;

}  // namespace pdsm
