// SPDX-License-Identifier: Apache-2.0
#include "events/accumulate.h"

#include <algorithm>
#include <cassert>

#include "events/sort_keys.h"

namespace pdsm {

void gather_events(std::span<const EventLog* const> logs, std::uint32_t texel_count, BlockEvents& events) {
  gather_by_texel(
      logs, texel_count, [](PackedEvent event) { return event_texel(event); },
      [](PackedEvent event) { return event_key(event); }, events);
}

void accumulate(std::span<EventKey> keys, StepFunction& function, std::vector<EventKey>& room) {
  sort_keys(keys, room);
  sum_events(keys, function);
}

void sum_events(std::span<const EventKey> keys, StepFunction& function) {
  assert(std::is_sorted(keys.begin(), keys.end()));
  function.depth.resize(keys.size());
  function.count.resize(keys.size());
  std::size_t steps = 0;
  std::uint32_t blocked = 0, before = 0;
  // Each key writes a step, and the last one of its depth keeps it: nobody can foresee which are.
  for (std::size_t n = 0; n < keys.size(); ++n) {
    blocked += key_unblocks(keys[n]) ? ~0u : 1u;
    function.depth[steps] = key_depth(keys[n]);
    function.count[steps] = blocked;
    const bool ends = n + 1 == keys.size() || key_depth(keys[n + 1]) != key_depth(keys[n]);
    steps += (ends & (blocked != before)) ? 1 : 0;
    before = ends ? blocked : before;
  }
  function.depth.resize(steps);
  function.count.resize(steps);
}

}  // namespace pdsm
