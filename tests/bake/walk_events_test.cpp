// SPDX-License-Identifier: Apache-2.0
// The shift-law walk, the general walk and the plain reference give the same events, bit for bit.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <limits>
#include <set>

#include "support/walk_case.h"
#include "walk/general_walk.h"
#include "walk/ray_packets.h"
#include "walk/reference_walk.h"
#include "walk/shift_walk.h"

namespace pdsm::test {
namespace {

using EventLists = std::vector<std::vector<DepthEvent>>;

EventBudget& endless_budget() {
  static EventBudget budget(std::numeric_limits<std::uint64_t>::max());
  return budget;
}

/// Case `number` with a filled map that covers the footprints of both walks.
struct FilledCase {
  WalkCase c;
  SampleMap map;

  FilledCase(std::uint64_t number, SamplePlane plane, Walk walk) {
    Random random(number);
    c = random_walk_case(random, plane);
    const std::vector<float> borders = border_depths(c, walk);
    draw_domain_ends(random, borders, c);
    map.reset(footprint(walk), c.grid.ratio[0].fine);
    fill_randomly(random, c, borders, map);
  }

  /// What both walks may read; the shift walk alone gets no more than it asked for.
  [[nodiscard]] TexelRect footprint(Walk walk) const {
    TexelRect rect = general_footprint(c.grid, c.sample, c.rect);
    if (!obeys_shift_law(c.grid, c.sample)) return rect;
    ShiftWalk shift;
    shift.list(c.grid, c.sample, walk);
    const TexelRect other = shift.footprint(c.rect);
    return {std::min(rect.x0, other.x0), std::min(rect.y0, other.y0), std::max(rect.x1, other.x1),
            std::max(rect.y1, other.y1)};
  }

  [[nodiscard]] EventLists walk_shifted(Walk walk) const {
    EventLog log(&endless_budget());
    ShiftWalk shift;
    shift.list(c.grid, c.sample, walk);
    shift.bind(map);
    const std::vector<RayPacket> packets = make_ray_packets(c.grid, c.rect, c.domain_ends);
    shift.walk(map, packets, log);
    return events_by_texel(log, texel_count(c.rect));
  }

  [[nodiscard]] EventLists walk_generally(Walk walk) const {
    EventLog log(&endless_budget());
    std::vector<WalkStep> steps;
    walk_general(c.grid, c.sample, walk, map, c.rect, c.domain_ends, steps, log);
    return events_by_texel(log, texel_count(c.rect));
  }

  [[nodiscard]] EventLists walk_by_reference(Walk walk) const {
    EventLists lists;
    const MapDepth depth = [&](std::int64_t x, std::int64_t y) { return map.at(x, y); };
    for (std::int32_t j = c.rect.y0; j < c.rect.y1; ++j) {
      for (std::int32_t i = c.rect.x0; i < c.rect.x1; ++i) {
        const RayPath path =
            make_ray_path(c.grid, c.sample, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        std::multiset<ReferenceEvent> events;
        insert_reference_events(path, walk, depth, c.domain_ends[lists.size()], events);
        std::vector<DepthEvent>& list = lists.emplace_back();
        for (const auto& [at, change] : events) list.push_back({at, change});
      }
    }
    return lists;
  }
};

/// As sets: the reference orders events of one depth by sign.
EventLists sorted(EventLists lists) {
  for (auto& list : lists) std::sort(list.begin(), list.end());
  return lists;
}

std::size_t count_events(const EventLists& lists) {
  std::size_t total = 0;
  for (const auto& list : lists) total += list.size();
  return total;
}

class WalkEvents : public testing::TestWithParam<Walk> {};

void expect_three_walks_agree(SamplePlane plane, Walk walk) {
  std::size_t events = 0;
  for (std::uint64_t n = 0; n < 1500; ++n) {
    const FilledCase filled(n, plane, walk);
    const EventLists general = filled.walk_generally(walk);
    ASSERT_EQ(filled.walk_shifted(walk), general) << "case " << n;
    ASSERT_EQ(sorted(general), filled.walk_by_reference(walk)) << "case " << n;
    events += count_events(general);
  }
  EXPECT_GT(events, 100000u) << "the cases must have events to compare";
}

TEST_P(WalkEvents, ShiftGeneralAndReferenceAgreeForPlanarSamples) {
  expect_three_walks_agree(SamplePlane::planar, GetParam());
}

TEST_P(WalkEvents, ShiftGeneralAndReferenceAgreeForDistantLights) {
  expect_three_walks_agree(SamplePlane::distant, GetParam());
}

TEST_P(WalkEvents, GeneralAndReferenceAgreeForTiltedSamples) {
  std::size_t events = 0;
  for (std::uint64_t n = 0; n < 1500; ++n) {
    const FilledCase filled(n, SamplePlane::tilted, GetParam());
    const EventLists general = filled.walk_generally(GetParam());
    ASSERT_EQ(sorted(general), filled.walk_by_reference(GetParam())) << "case " << n;
    events += count_events(general);
  }
  EXPECT_GT(events, 100000u) << "the cases must have events to compare";
}

TEST_P(WalkEvents, EverySimdTargetGivesTheSameEvents) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    for (std::uint64_t n = 0; n < 200; ++n) {
      const FilledCase filled(n, SamplePlane::planar, GetParam());
      EXPECT_EQ(filled.walk_shifted(GetParam()), filled.walk_generally(GetParam())) << "case " << n;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST_P(WalkEvents, ShiftWalkReadsNothingOutsideItsFootprint) {
  for (std::uint64_t n = 0; n < 500; ++n) {
    const FilledCase filled(n, n % 2 == 0 ? SamplePlane::planar : SamplePlane::distant, GetParam());
    const WalkCase& c = filled.c;
    ShiftWalk shift;
    shift.list(c.grid, c.sample, GetParam());
    const TexelRect footprint = shift.footprint(c.rect);
    std::vector<WalkStep> steps;
    for (std::int32_t j = c.rect.y0; j < c.rect.y1; ++j) {
      for (std::int32_t i = c.rect.x0; i < c.rect.x1; ++i) {
        const RayPath path =
            make_ray_path(c.grid, c.sample, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        list_walk_steps(path, GetParam(), steps);
        for (const WalkStep& step : steps) {
          const std::int64_t x = path.base[0] + step.dx, y = path.base[1] + step.dy;
          ASSERT_TRUE(x >= footprint.x0 && x < footprint.x1 && y >= footprint.y0 && y < footprint.y1)
              << "case " << n << ", ray " << i << ", " << j;
        }
      }
    }
  }
}

/// A ray is blocked exactly where the map is nearer: the state behind each event follows from the map alone.
TEST_P(WalkEvents, EventsOfARayAlternateAndStayInItsDomain) {
  for (std::uint64_t n = 0; n < 300; ++n) {
    const FilledCase filled(n, SamplePlane::planar, GetParam());
    const EventLists lists = filled.walk_generally(GetParam());
    for (std::size_t t = 0; t < lists.size(); ++t) {
      int blocked = 0;
      float depth = 0;
      for (const DepthEvent& event : lists[t]) {
        blocked += event.change;
        ASSERT_TRUE(blocked == 0 || blocked == 1) << "case " << n;
        ASSERT_LE(depth, event.depth) << "case " << n;
        ASSERT_LT(event.depth, filled.c.domain_ends[t]) << "case " << n;
        ASSERT_GE(event.depth, static_cast<float>(filled.c.grid.near_depth)) << "case " << n;
        depth = event.depth;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothWalks, WalkEvents, testing::Values(Walk::midpoint, Walk::exact),
                         [](const auto& walk) { return walk.param == Walk::exact ? "Exact" : "Midpoint"; });

TEST(AccumulateReference, CountsAreThoseBehindEachDepth) {
  const std::multiset<ReferenceEvent> events{{1.0F, 1}, {2.0F, 1}, {2.0F, -1}, {2.0F, 1}, {3.0F, -1}};
  const std::vector<std::pair<float, int>> expected{{1.0F, 1}, {2.0F, 2}, {3.0F, 1}};
  EXPECT_EQ(accumulate_reference(events), expected);
}

}  // namespace
}  // namespace pdsm::test
