// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "events/accumulate.h"
#include "fit/fit_rules.h"
#include "fit/stabbing_lines.h"
#include "fit/tube.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Room to work in; keep one a thread.
struct FitWorkspace {
  TubeWorkspace tube_room;
  std::vector<TubeRun> tube;
  StabbingLines lines;
};

/// Fits a function with the fewest pieces that any function of vertices at whole depth codes needs to stay
/// in the tube (tube.h): each piece reaches as far as it can, the first being the 0 that needs no vertex,
/// the last a constant that holds for ever. Within that, each piece is the least-squares line, moved into
/// the tube where it leaves it. Replaces the contents of `vertices`. Deterministic.
/// With `bands` (see relax_tube) the tube holds in these alone.
void fit_function(const StepFunction& function, const FitRules& rules, FitWorkspace& room,
                  std::vector<FunctionVertex>& vertices, const std::vector<CodeBand>* bands = nullptr);

}  // namespace pdsm
