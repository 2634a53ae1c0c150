// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Whether `light` of `scene` would give another map than `map` by the map's own options: whether the key has
/// changed (pdsm/bake/map_key.h). False where the map does not tell its key and all options.
[[nodiscard]] bool changed_since_bake(const Scene& scene, const Light& light, const PenumbraMap& map);

/// Warns when that is so.
void warn_if_changed(const Scene& scene, const Light& light, const PenumbraMap& map,
                     const std::string& map_name);

}  // namespace pdsm
