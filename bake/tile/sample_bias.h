// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/bake.h"
#include "trace/sample_map.h"

namespace pdsm {

/// Bias of one light sample's map (docs/maths.md, "Bias"): `constant` metres, and the reach that `walk`
/// needs. `shift_law`: all samples of the bake obey it, so that one path serves all rays.
[[nodiscard]] MapBias sample_bias(const MapGrid& grid, Walk walk, bool shift_law, double constant,
                                  const LightSample& sample);

}  // namespace pdsm
