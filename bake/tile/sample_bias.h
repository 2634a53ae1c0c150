// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/bake.h"
#include "trace/sample_map.h"

namespace pdsm {

/// What all maps of a bake have in common of their bias.
struct DepthBias {
  double constant = 0;      ///< metres
  double limited_from = 0;  ///< metres, as MapBias has it
};

/// Bias of one light sample's map (docs/maths.md, "Bias"), with the reach that `walk` needs. `shift_law`: all
/// samples of the bake obey it, so that one path serves all rays.
[[nodiscard]] MapBias sample_bias(const MapGrid& grid, Walk walk, bool shift_law, const DepthBias& depth_bias,
                                  const LightSample& sample);

}  // namespace pdsm
