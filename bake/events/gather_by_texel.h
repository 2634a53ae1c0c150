// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "events/event_log.h"

namespace pdsm {

/// Events of a block, gathered by texel: texel t owns keys[first[t]] .. keys[first[t + 1] - 1].
template <typename Key>
struct TexelKeys {
  std::vector<std::uint32_t> first;
  std::vector<Key> keys;
};

/// Gathers the events that several threads logged for one block of `texel_count` texels: texel_of(event)
/// tells where each belongs, key_of(event) what is kept of it. Counting sort: the order within a texel is not
/// defined.
template <typename Key, typename TexelOf, typename KeyOf>
void gather_by_texel(std::span<const EventLog* const> logs, std::uint32_t texel_count, TexelOf texel_of,
                     KeyOf key_of, TexelKeys<Key>& gathered) {
  std::vector<std::uint32_t>& first = gathered.first;
  // Slot t + 2 counts texel t; after the running sum, slot t + 1 is where texel t's next key goes, and
  // once all are placed, slot t + 1 has become texel t's end.
  first.assign(texel_count + 2, 0);
  for (const EventLog* log : logs) log->for_each([&](PackedEvent event) { ++first[texel_of(event) + 2]; });
  for (std::size_t t = 2; t < first.size(); ++t) first[t] += first[t - 1];
  gathered.keys.resize(first.back());
  for (const EventLog* log : logs)
    log->for_each([&](PackedEvent event) { gathered.keys[first[texel_of(event) + 1]++] = key_of(event); });
  first.pop_back();
}

}  // namespace pdsm
