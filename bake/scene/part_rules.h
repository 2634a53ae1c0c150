// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pdsm/bake/scene.h"
#include "scene/json_fields.h"
#include "scene/part_names.h"

namespace pdsm {

/// Gives `parts` of a file what the rules under "parts" of `fields` say of their nodes and materials, in
/// order; a later rule goes over an earlier one. `names`: one a part. Throws Error (input) for rules that are
/// not as docs/scene.md says, and for one that fits no part.
void apply_part_rules(const JsonFields& fields, const std::vector<PartNames>& names,
                      std::vector<Geometry>& parts);

}  // namespace pdsm
