// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "events/event_log.h"
#include "events/gather_by_texel.h"

namespace pdsm {

/// A step function of depth: 0 up to the first depth, then count[n] / N on (depth[n], depth[n + 1]].
/// Depths increase strictly, neighbouring counts differ. Exact.
struct StepFunction {
  std::vector<float> depth;
  std::vector<std::uint32_t> count;
};

using BlockEvents = TexelKeys<EventKey>;

/// gather_by_texel(); accumulate() sorts what a texel has.
void gather_events(std::span<const EventLog* const> logs, std::uint32_t texel_count, BlockEvents& events);

/// Sorts the keys of one texel and sums them up (sum_events). `room` is to work in.
void accumulate(std::span<EventKey> keys, StepFunction& function, std::vector<EventKey>& room);

/// Sums up sorted keys in integers. Events at one depth are applied together, so the result depends on the
/// set of events alone. Replaces the contents of `function`.
void sum_events(std::span<const EventKey> keys, StepFunction& function);

}  // namespace pdsm
