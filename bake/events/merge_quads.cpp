// SPDX-License-Identifier: Apache-2.0
#include "events/merge_quads.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace pdsm {
namespace {

using Keys = std::span<const EventKey>;

/// Merges two sorted lists without a branch for each key: which list is next can't be foretold.
EventKey* merge(Keys a, Keys b, EventKey* out) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const bool take_b = b[j] < a[i];
    *out++ = take_b ? b[j] : a[i];
    i += take_b ? 0 : 1;
    j += take_b ? 1 : 0;
  }
  out = std::copy(a.begin() + static_cast<std::ptrdiff_t>(i), a.end(), out);
  return std::copy(b.begin() + static_cast<std::ptrdiff_t>(j), b.end(), out);
}

Keys keys_of(const BlockEvents& events, std::uint32_t texel) {
  return Keys(events.keys).subspan(events.first[texel], events.first[texel + 1] - events.first[texel]);
}

}  // namespace

void merge_quads(const BlockEvents& texels, std::uint32_t width, std::uint32_t height, BlockEvents& quads,
                 std::vector<EventKey>& room) {
  assert(texels.first.size() == std::size_t{width} * height + 1);
  quads.first.assign(1, 0);
  quads.keys.resize(texels.keys.size());
  for (std::uint32_t j = 0; j < height / 2; ++j) {
    for (std::uint32_t i = 0; i < width / 2; ++i) {
      const std::uint32_t lower = 2 * j * width + 2 * i, upper = lower + width;
      const Keys a = keys_of(texels, lower), b = keys_of(texels, lower + 1), c = keys_of(texels, upper),
                 d = keys_of(texels, upper + 1);
      room.resize(a.size() + b.size() + c.size() + d.size());
      EventKey* const middle = merge(a, b, room.data());
      EventKey* const end = merge(c, d, middle);
      merge({room.data(), middle}, {middle, end}, quads.keys.data() + quads.first.back());
      quads.first.push_back(quads.first.back() + static_cast<std::uint32_t>(room.size()));
    }
  }
  quads.keys.resize(quads.first.back());
}

}  // namespace pdsm
