// SPDX-License-Identifier: Apache-2.0
#include "events/sort_keys.h"

#include <algorithm>
#include <array>

namespace pdsm {
namespace {

/// From so many keys on, counting digits pays.
constexpr std::size_t kManyKeys = 96;
constexpr std::uint32_t kDigitBits = 8, kDigits = 1u << kDigitBits, kDigitPasses = 32 / kDigitBits;

}  // namespace

void sort_keys(std::span<EventKey> keys, std::vector<EventKey>& room) {
  if (keys.size() < kManyKeys) {
    std::sort(keys.begin(), keys.end());
    return;
  }
  std::array<std::array<std::uint32_t, kDigits>, kDigitPasses> counts{};
  for (const EventKey key : keys)
    for (std::uint32_t pass = 0; pass < kDigitPasses; ++pass)
      ++counts[pass][key >> (pass * kDigitBits) & (kDigits - 1)];
  room.resize(std::max(room.size(), keys.size()));
  EventKey *from = keys.data(), *to = room.data();
  for (std::uint32_t pass = 0; pass < kDigitPasses; ++pass) {
    const std::uint32_t shift = pass * kDigitBits;
    auto& count = counts[pass];
    // A digit that all keys share, as depths do their first, orders nothing.
    if (count[from[0] >> shift & (kDigits - 1)] == keys.size()) continue;
    std::uint32_t next = 0;
    for (std::uint32_t& digit : count) {
      const std::uint32_t first = next;
      next += digit;
      digit = first;
    }
    for (std::size_t n = 0; n < keys.size(); ++n) to[count[from[n] >> shift & (kDigits - 1)]++] = from[n];
    std::swap(from, to);
  }
  if (from != keys.data()) std::copy_n(from, keys.size(), keys.data());
}

}  // namespace pdsm
