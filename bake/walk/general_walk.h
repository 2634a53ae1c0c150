// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "events/event_log.h"
#include "trace/sample_map.h"
#include "walk/layer_walk.h"
#include "walk/walk_steps.h"

/// The walk of the thesis, for samples out of the light's plane: each ray is projected and scan-converted
/// by itself.
namespace pdsm {

/// The map texels that the rays of `rays` (texels of the PDSM) need of the map of `sample`.
[[nodiscard]] TexelRect general_footprint(const MapGrid& grid, const LightSample& sample,
                                          const TexelRect& rays);

/// Appends the events of all rays of the block at `rect` to `log`. `domain_ends`: one value a texel of the
/// block, row by row. `map` covers general_footprint(). `steps` is room to work in.
void walk_general(const MapGrid& grid, const LightSample& sample, Walk walk, const SampleMap& map,
                  const TexelRect& rect, std::span<const float> domain_ends, std::vector<WalkStep>& steps,
                  EventLog& log);

/// The same of a map with layers, as changes of transmittance.
void walk_general(const MapGrid& grid, const LightSample& sample, Walk walk, const LayeredMap& map,
                  const TexelRect& rect, std::span<const float> domain_ends, std::vector<WalkStep>& steps,
                  EventLog& log);

}  // namespace pdsm
