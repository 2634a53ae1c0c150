// SPDX-License-Identifier: Apache-2.0
#include "events/transmittance_events.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kTexelMask = 0xfff;

std::uint32_t texel_of(PackedEvent event) {
  return event_texel(event) & kTexelMask;
}

ChangeKey change_key(PackedEvent event) {
  return static_cast<ChangeKey>(event_key(event)) << 32 | event >> kMagnitudeShift;
}

EventKey event_key_of(ChangeKey key) {
  return static_cast<EventKey>(key >> 32);
}

/// What of the sample gets blocked, negative where it gets unblocked.
std::int64_t change_of(ChangeKey key, std::uint32_t unit) {
  const auto magnitude = static_cast<std::uint32_t>(key);
  const std::int64_t change = magnitude == 0 ? unit : magnitude;
  return key_unblocks(event_key_of(key)) ? -change : change;
}

}  // namespace

void gather_changes(std::span<const EventLog* const> logs, std::uint32_t texel_count, BlockChanges& changes) {
  gather_by_texel(logs, texel_count, texel_of, change_key, changes);
}

void join_quads(const BlockChanges& texels, std::uint32_t width, std::uint32_t height, BlockChanges& quads) {
  quads.first.assign(1, 0);
  quads.keys.clear();
  for (std::uint32_t j = 0; j < height / 2; ++j) {
    for (std::uint32_t i = 0; i < width / 2; ++i) {
      const std::uint32_t lower = 2 * j * width + 2 * i, upper = lower + width;
      for (const std::uint32_t texel : {lower, lower + 1, upper, upper + 1}) {
        const auto begin = texels.keys.begin();
        quads.keys.insert(quads.keys.end(), begin + texels.first[texel], begin + texels.first[texel + 1]);
      }
      quads.first.push_back(static_cast<std::uint32_t>(quads.keys.size()));
    }
  }
}

void sum_changes(std::span<ChangeKey> keys, std::uint32_t unit, std::uint32_t level, StepFunction& function) {
  std::ranges::sort(keys);
  function.depth.clear();
  function.count.clear();
  const std::int64_t half = level == 0 ? 0 : std::int64_t{1} << (2 * level - 1);
  std::int64_t blocked = 0;
  std::uint32_t before = 0;
  for (std::size_t n = 0; n < keys.size(); ++n) {
    blocked += change_of(keys[n], unit);
    const float depth = key_depth(event_key_of(keys[n]));
    if (n + 1 < keys.size() && key_depth(event_key_of(keys[n + 1])) == depth) continue;
    const auto count = static_cast<std::uint32_t>((blocked + half) >> (2 * level));
    if (count == before) continue;
    function.depth.push_back(depth);
    function.count.push_back(count);
    before = count;
  }
}

}  // namespace pdsm
