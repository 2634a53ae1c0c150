// SPDX-License-Identifier: Apache-2.0
// Events of a level's texel: those of its four children, sorted.
#include "events/merge_quads.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.h"

namespace pdsm::test {
namespace {

/// Sorted keys for each texel; many tie, many texels have none.
BlockEvents random_events(Random& random, std::uint32_t texels) {
  BlockEvents events;
  events.first.push_back(0);
  for (std::uint32_t t = 0; t < texels; ++t) {
    const std::uint32_t count = random.chance(0.3) ? 0 : random.count(0, 20);
    for (std::uint32_t n = 0; n < count; ++n)
      events.keys.push_back(event_key(pack_event(0, static_cast<float>(random.count(1, 30)), n % 2 == 1)));
    std::sort(events.keys.end() - count, events.keys.end());
    events.first.push_back(static_cast<std::uint32_t>(events.keys.size()));
  }
  return events;
}

std::vector<EventKey> keys_of(const BlockEvents& events, std::uint32_t texel) {
  return {events.keys.begin() + events.first[texel], events.keys.begin() + events.first[texel + 1]};
}

TEST(MergeQuads, GathersFourTexelsInOrder) {
  Random random(81);
  BlockEvents quads;
  std::vector<EventKey> room;
  for (int n = 0; n < 200; ++n) {
    const std::uint32_t width = random.count(1, 9), height = random.count(1, 9);
    const BlockEvents texels = random_events(random, width * height);
    merge_quads(texels, width, height, quads, room);
    ASSERT_EQ(quads.first.size(), (width / 2) * (height / 2) + 1u);
    ASSERT_EQ(quads.keys.size(), quads.first.back());
    for (std::uint32_t t = 0; t + 1 < quads.first.size(); ++t) {
      const std::uint32_t i = t % (width / 2), j = t / (width / 2);
      std::vector<EventKey> expected;
      for (const std::uint32_t child : {0u, 1u, width, width + 1}) {
        const std::vector<EventKey> keys = keys_of(texels, 2 * j * width + 2 * i + child);
        expected.insert(expected.end(), keys.begin(), keys.end());
      }
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(keys_of(quads, t), expected) << width << " x " << height << ", texel " << t;
    }
  }
}

}  // namespace
}  // namespace pdsm::test
