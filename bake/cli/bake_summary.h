// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/light_bake.h"

namespace pdsm {

/// A level's bake at a glance, line by line: one for each light, then the totals.
[[nodiscard]] std::vector<std::string> summary_lines(const std::vector<LightOutcome>& outcomes,
                                                     double seconds);

}  // namespace pdsm
