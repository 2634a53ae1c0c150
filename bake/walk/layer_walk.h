// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "events/event_log.h"
#include "trace/layer_map.h"
#include "walk/walk_steps.h"

namespace pdsm {

/// One sample's map with what lies before its opaque casters, in 1 / `unit` of transmittance.
struct LayeredMap {
  const SampleMap& opaque;
  const LayerMap& layers;
  std::uint32_t unit;
};

/// Walks one ray, whose steps are from the map texel (x, y), and appends the changes of its transmittance
/// (events/transmittance_events.h). Within each texel, each surface darkens the ray from max(depth, begin)
/// on, as it does where all are opaque.
void walk_layers(const LayeredMap& map, std::span<const WalkStep> steps, std::int64_t x, std::int64_t y,
                 std::uint32_t texel, float domain_end, EventLog& log);

}  // namespace pdsm
