// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "choose/search.h"
#include "cli/bake_options.h"

namespace pdsm {

/// Bakes one light to the command's goals, with progress on a terminal. `time_budget` replaces the
/// command's: this light's share of it. Throws as choose_bake does, and Error (interrupted) at a signal.
[[nodiscard]] ChosenBake bake_to_goals(const BakeCommand& command, const Scene& scene, const Light& light,
                                       const BakeOptions& options, std::optional<double> time_budget);

/// One line for those who wait: what was chosen, and what it reached.
[[nodiscard]] std::string chosen_text(const ChosenBake& chosen);

}  // namespace pdsm
