// SPDX-License-Identifier: Apache-2.0
// Events on their way from the walks to step functions: exact counts, whatever the order.
#include "events/accumulate.h"
#include "events/sort_keys.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "support/random.h"

namespace pdsm::test {
namespace {

constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

EventKey key(float depth, bool unblocks) {
  return event_key(pack_event(0, depth, unblocks));
}

/// Events of `samples` samples, each blocked and freed in turn at depths of few values: many events tie.
std::vector<EventKey> random_keys(Random& random, std::uint32_t samples, int depths) {
  std::vector<EventKey> keys;
  for (std::uint32_t n = 0; n < samples; ++n) {
    bool unblocks = false;
    for (std::int64_t at = random.integer(0, depths); at < depths; at += random.integer(0, 3)) {
      keys.push_back(key(1.0F + 0.25F * static_cast<float>(at), unblocks));
      unblocks = !unblocks;
      if (random.chance(0.1)) break;
    }
  }
  random.shuffle(keys);
  return keys;
}

StepFunction accumulate_plainly(const std::vector<EventKey>& keys) {
  std::map<float, int> changes;
  for (const EventKey k : keys) changes[key_depth(k)] += key_unblocks(k) ? -1 : 1;
  StepFunction function;
  int blocked = 0;
  for (const auto& [depth, change] : changes) {
    blocked += change;
    if (change == 0) continue;
    function.depth.push_back(depth);
    function.count.push_back(static_cast<std::uint32_t>(blocked));
  }
  return function;
}

void expect_equal(const StepFunction& a, const StepFunction& b) {
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.count, b.count);
}

TEST(PackedEvent, KeepsItsPartsAndOrdersByDepth) {
  Random random(71);
  for (int n = 0; n < 10000; ++n) {
    const std::uint32_t texel = random.count(0, 4095);
    const auto a = static_cast<float>(std::exp2(random.uniform(-126, 126))),
               b = static_cast<float>(std::exp2(random.uniform(-126, 126)));
    const PackedEvent event = pack_event(texel, a, n % 2 == 0);
    ASSERT_EQ(event_texel(event), texel);
    ASSERT_EQ(key_depth(event_key(event)), a);
    ASSERT_EQ(key_unblocks(event_key(event)), n % 2 == 0);
    ASSERT_TRUE(!(a < b) || key(a, true) < key(b, false));
  }
}

TEST(Accumulate, SumsInIntegers) {
  Random random(72);
  StepFunction function;
  std::vector<EventKey> room;
  for (int n = 0; n < 500; ++n) {
    std::vector<EventKey> keys =
        random_keys(random, random.count(0, 60), static_cast<int>(random.integer(1, 30)));
    const StepFunction expected = accumulate_plainly(keys);
    accumulate(keys, function, room);
    expect_equal(function, expected);
  }
}

TEST(Accumulate, CountsUpTo65536AndBack) {
  std::vector<EventKey> keys;
  for (std::uint32_t n = 0; n < 65536; ++n) {
    keys.push_back(key(1.0F + static_cast<float>(n) * 0x1.0p-10F, false));
    keys.push_back(key(100.0F, true));
  }
  StepFunction function;
  std::vector<EventKey> room;
  accumulate(keys, function, room);
  ASSERT_EQ(function.count.size(), 65537u);
  for (std::uint32_t n = 0; n < 65536; ++n) ASSERT_EQ(function.count[n], n + 1);
  EXPECT_EQ(function.count.back(), 0u);
}

/// Many keys take another way than few: same order, with ties, and with digits that all keys share.
TEST(SortKeys, SortsAnyNumberOfAnyKeys) {
  Random random(73);
  std::vector<EventKey> room;
  for (int n = 0; n < 300; ++n) {
    const std::uint32_t mask = random.pick({0xffffffffu, 0x00ffffffu, 0xff00ff00u, 0x3fu, 0u});
    const std::uint32_t base = random.count(0, 1 << 30) & ~mask;
    std::vector<EventKey> keys(random.count(0, 700));
    for (EventKey& one : keys) one = base | ((random.count(0, 0x7fffffff) * 2u + random.count(0, 1)) & mask);
    std::vector<EventKey> expected = keys;
    std::sort(expected.begin(), expected.end());
    sort_keys(keys, room);
    ASSERT_EQ(keys, expected) << keys.size() << " keys, mask " << mask;
  }
}

/// All events of one depth count together: none of their sums shows.
TEST(Accumulate, AppliesTiesTogether) {
  StepFunction function;
  std::vector<EventKey> room;
  std::vector<EventKey> keys{key(2, true), key(2, false), key(1, false), key(2, false), key(2, false)};
  accumulate(keys, function, room);
  expect_equal(function, {{1, 2}, {1, 3}});
  // A change that cancels itself is none.
  keys = {key(1, false), key(2, true), key(2, false), key(3, true)};
  accumulate(keys, function, room);
  expect_equal(function, {{1, 3}, {1, 0}});
  keys.clear();
  accumulate(keys, function, room);
  expect_equal(function, {});
}

TEST(Accumulate, DoesNotDependOnOrder) {
  EXPECT_TRUE(rc::check("accumulate(shuffled) = accumulate(events)", [](std::uint64_t seed) {
    Random random(seed);
    std::vector<EventKey> keys = random_keys(random, random.count(1, 40), 12), shuffled = keys;
    random.shuffle(shuffled);
    StepFunction a, b;
    std::vector<EventKey> room;
    accumulate(keys, a, room);
    accumulate(shuffled, b, room);
    RC_ASSERT(a.depth == b.depth);
    RC_ASSERT(a.count == b.count);
  }));
}

/// Several threads' logs, of none to several pages, for a block some of whose texels have no event.
TEST(GatherEvents, CollectsEachTexelsEventsFromAllLogs) {
  Random random(73);
  BlockEvents gathered;
  for (int n = 0; n < 60; ++n) {
    EventBudget budget(kEndless);
    const std::uint32_t texels = random.count(1, 4096);
    std::vector<std::multiset<EventKey>> expected(texels);
    std::vector<EventLog> logs;
    std::uint64_t total = 0;
    const std::int64_t log_count = random.integer(0, 4);
    for (std::int64_t l = 0; l < log_count; ++l) {
      EventLog& log = logs.emplace_back(&budget);
      const std::int64_t batches = random.pick({0, 1, 50, 200});
      for (std::int64_t b = 0; b < batches; ++b) {
        // Room for 32, of which some are used, as the kernel does.
        PackedEvent* room = log.reserve(32);
        const std::uint32_t used = random.count(0, 32);
        for (std::uint32_t e = 0; e < used; ++e) {
          const std::uint32_t texel = random.count(0, texels - 1) / 3 * 3 % texels;
          room[e] = pack_event(texel, static_cast<float>(random.uniform(1, 9)), random.chance(0.5));
          expected[texel].insert(event_key(room[e]));
        }
        log.commit(used);
        total += used;
      }
    }
    std::vector<const EventLog*> pointers;
    std::uint64_t sizes = 0;
    for (const EventLog& log : logs) {
      pointers.push_back(&log);
      sizes += log.size();
    }
    EXPECT_EQ(sizes, total);
    gather_events(pointers, texels, gathered);
    ASSERT_EQ(gathered.first.size(), texels + 1u);
    ASSERT_EQ(gathered.first.front(), 0u);
    ASSERT_EQ(gathered.keys.size(), total);
    for (std::uint32_t t = 0; t < texels; ++t) {
      const std::multiset<EventKey> actual(gathered.keys.begin() + gathered.first[t],
                                           gathered.keys.begin() + gathered.first[t + 1]);
      ASSERT_EQ(actual, expected[t]) << "texel " << t;
    }
  }
}

TEST(EventBudget, TellsWhenLogsTakeMoreThanTheirShare) {
  constexpr std::uint64_t kPage = EventLog::kPageEvents * sizeof(PackedEvent);
  EventBudget budget(2 * kPage);
  EventLog a(&budget), b(&budget);
  const auto fill_page = [](EventLog& log) {
    std::fill_n(log.reserve(EventLog::kPageEvents), EventLog::kPageEvents, pack_event(0, 1, false));
    log.commit(EventLog::kPageEvents);
  };
  EXPECT_EQ(budget.used(), 0u);
  fill_page(a);
  fill_page(b);
  EXPECT_EQ(budget.used(), 2 * kPage);
  EXPECT_FALSE(budget.exceeded());
  fill_page(a);
  EXPECT_TRUE(budget.exceeded());
  // From here on nothing more is taken: the tile is thrown away.
  const std::uint64_t used = budget.used();
  for (int n = 0; n < 100; ++n) fill_page(b);
  EXPECT_EQ(budget.used(), used);
  a.clear();
  EXPECT_EQ(a.size(), 0u);
}

}  // namespace
}  // namespace pdsm::test
