// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "events/event_log.h"
#include "walk/ray_packets.h"

namespace pdsm {

struct StepTable;

/// Walks each packet through `map` and appends the events of its rays to `log`. SIMD of the widest kind
/// this machine has; the events are the same for all (only loads and comparisons).
void walk_ray_packets(const StepTable& steps, const float* map, std::int64_t row_pitch,
                      std::span<const RayPacket> packets, EventLog& log);

}  // namespace pdsm
