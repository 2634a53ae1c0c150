// SPDX-License-Identifier: Apache-2.0
// Tiles end soon enough that an interrupted bake loses little, where that is nearly free.
#include "tile/tile_plan.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "tile/block_grid.h"

namespace pdsm::test {
namespace {

constexpr std::uint64_t kPlenty = std::uint64_t{1} << 40;

/// A light of `width` metres, 12 m above the ground.
TilePlan plan(double width, std::uint32_t edge, std::uint32_t samples, double near_depth,
              std::uint64_t memory) {
  View view;
  view.window = {-0.35, -0.35, 0.35, 0.35};
  view.near_depth = near_depth;
  view.far_depth = 12;
  view.width = view.height = edge;
  const MapGrid grid = make_map_grid(view, edge, edge);
  const auto points = make_light_samples(rect_light(width, width), samples, PointSet::lattice, 0);
  return plan_tiles({grid, points, Walk::exact, 2, memory, 0});
}

TEST(TilePlan, ShortBakesAreOneTile) {
  EXPECT_EQ(plan(3, 512, 256, 7.8, kPlenty).tiles.size(), 1U);
}

TEST(TilePlan, TilesOfLongBakesAreShort) {
  const TilePlan long_one = plan(0.3, 4096, 1024, 7.8, kPlenty);
  EXPECT_LE(long_one.tile_seconds, 60);
  // Twice the edge is four times the seconds, so one is as large as it may be.
  EXPECT_GT(long_one.tile_seconds, 60 / 4.5);
}

TEST(TilePlan, MarginsAreNotPaidForIt) {
  // Walks of some thousand texels: a smaller tile takes nearly as long.
  const TilePlan far_reaching = plan(3, 1024, 64, 0.2, kPlenty);
  EXPECT_EQ(far_reaching.tiles.size(), 1U);
  EXPECT_GT(far_reaching.tile_seconds, 60);
}

TEST(TilePlan, CoversEachBlockOnce) {
  const TilePlan tiles = plan(3, 1000, 16, 7.8, std::uint64_t{80} << 20);
  ASSERT_GT(tiles.tiles.size(), 1U);
  std::size_t area = 0;
  for (const TexelRect& tile : tiles.tiles) area += tile.area();
  EXPECT_EQ(area, 1000U * 1000U);
}

}  // namespace
}  // namespace pdsm::test
