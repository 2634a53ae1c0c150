// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "choose/settings.h"

namespace pdsm {

/// Settings by a name, for those who do not want to think about them (docs/commands.md has what they lead
/// to). A goal reaches the same error on every scene; these take about the same time and room on each.
enum class Quality { draft, game, final };

[[nodiscard]] Settings quality_settings(Quality quality);

}  // namespace pdsm
