// SPDX-License-Identifier: Apache-2.0
// Shards of a bake, merged, are the bake.
#include "pdsm/bake/shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>

#include "part/part_layout.h"
#include "part/part_records.h"
#include "pdsm/format/error.h"
#include "scratch_folder.h"
#include "support/checkpoint_case.h"
#include "support/random.h"
#include "tile/block_grid.h"
#include "tile/share_rect.h"

namespace pdsm::test {
namespace {

namespace fs = std::filesystem;
using pdsm::testing::file_content;
using pdsm::testing::put_file;
using pdsm::testing::ScratchFolder;

MapGrid grid_of(std::uint32_t width, std::uint32_t height) {
  MapGrid grid;
  grid.texels = {width, height};
  return grid;
}

TEST(ShareRect, SharesCoverEachBlockOnce) {
  for (const auto& [width, height] :
       {std::pair(64U, 64U), {150U, 129U}, {1000U, 100U}, {70U, 900U}, {512U, 512U}}) {
    const MapGrid grid = grid_of(width, height);
    for (std::uint32_t count = 1; count <= block_count(grid); ++count) {
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height) + " by " + std::to_string(count));
      std::vector<int> covered(block_count(grid));
      for (std::uint32_t index = 1; index <= count; ++index) {
        const TexelRect rect = share_rect(grid, {index, count});
        ASSERT_LT(rect.x0, rect.x1);
        ASSERT_LT(rect.y0, rect.y1);
        for (std::int32_t y = rect.y0; y < rect.y1; y += 64)
          for (std::int32_t x = rect.x0; x < rect.x1; x += 64) ++covered[block_at(grid, x, y)];
      }
      EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), static_cast<std::ptrdiff_t>(covered.size()));
    }
  }
}

TEST(ShareRect, SharesAreOfOneSize) {
  // 32 x 32 blocks: no share is more than a row or column of its rectangle away from its due.
  const MapGrid grid = grid_of(2048, 2048);
  for (const std::uint32_t count : {2U, 3U, 4U, 7U, 16U, 64U}) {
    const double due = 2048.0 * 2048 / count;
    for (std::uint32_t index = 1; index <= count; ++index) {
      const auto area = static_cast<double>(share_rect(grid, {index, count}).area());
      EXPECT_NEAR(area, due, 0.25 * due) << index << "/" << count;
    }
  }
}

TEST(ShareRect, MoreSharesThanBlocksAreRefused) {
  EXPECT_NO_THROW(static_cast<void>(share_rect(grid_of(65, 64), {2, 2})));
  EXPECT_THROW(static_cast<void>(share_rect(grid_of(65, 64), {1, 3})), Error);
}

class ShardTest : public ::testing::Test {
 protected:
  static const BakedMap& whole() {
    static const BakedMap baked = bake(checkpoint_scene(), checkpoint_light(), checkpoint_options());
    return baked;
  }
  fs::path bake_share(const std::string& name, const Share& share,
                      const BakeOptions& options = checkpoint_options(),
                      const std::string& description = "{}") const {
    const fs::path path = folder_.path() / name;
    const std::uint64_t size = bake_shard(
        checkpoint_scene(), checkpoint_light(), options, share, [&](const BakedMap&) { return description; },
        path);
    EXPECT_EQ(size, fs::file_size(path));
    return path;
  }
  std::vector<fs::path> bake_shares(std::uint32_t count) const {
    std::vector<fs::path> paths;
    for (std::uint32_t index = 1; index <= count; ++index)
      paths.push_back(bake_share(std::to_string(index), {index, count}));
    return paths;
  }
  /// Merging throws Error (input) with this message, but for the folder.
  void expect_refused(const std::vector<fs::path>& paths, const std::string& message) const {
    try {
      static_cast<void>(merge_shards(paths));
      ADD_FAILURE() << "not refused: " << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      std::string what = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (std::size_t at; (at = what.find(folder)) != std::string::npos;) what.erase(at, folder.size());
      EXPECT_EQ(what, message);
    }
  }

  ScratchFolder folder_;
};

TEST_F(ShardTest, MergedTheyAreTheBake) {
  for (const std::uint32_t count : {1U, 2U, 4U, 9U}) {
    SCOPED_TRACE(count);
    std::vector<fs::path> paths = bake_shares(count);
    std::reverse(paths.begin(), paths.end());
    const BakedMap merged = merge_shards(paths);
    expect_same_bake(merged, whole());
    EXPECT_EQ(merged.map.views, whole().map.views);
    EXPECT_EQ(merged.map.coding, whole().map.coding);
    EXPECT_EQ(merged.map.samples, whole().map.samples);
    EXPECT_EQ(merged.report.rays, whole().report.rays) << "the same tiles, a block each";
    EXPECT_EQ(merged.report.max_slope_bias, whole().report.max_slope_bias);
    EXPECT_EQ(merged.report.map_width, whole().report.map_width);
    EXPECT_EQ(merged.report.isa, whole().report.isa);
    EXPECT_EQ(merged.fitted.window_fitted, whole().fitted.window_fitted);
    EXPECT_EQ(merged.fitted.far_fitted, whole().fitted.far_fitted);
  }
}

TEST_F(ShardTest, EachMachineMayHaveItsOwnThreadsAndTiles) {
  BakeOptions other = checkpoint_options();
  other.threads = 3;
  other.tile = 0;
  other.memory /= 2;
  expect_same_bake(merge_shards(std::vector{bake_share("a", {1, 2}), bake_share("b", {2, 2}, other)}),
                   whole());
}

TEST_F(ShardTest, EveryKindOfBakeCanBeShared) {
  const std::vector<std::function<void(BakeOptions&)>> kinds{
      [](BakeOptions& o) { o.receivers = Receivers::all; },
      [](BakeOptions& o) { o.receivers = Receivers::surfaces; },
      [](BakeOptions& o) { o.epsilon = 0; },
      [](BakeOptions& o) { o.mip_levels = 0; },
  };
  for (const auto& change : kinds) {
    BakeOptions options = checkpoint_options();
    change(options);
    const std::vector paths{bake_share("a", {1, 2}, options), bake_share("b", {2, 2}, options)};
    expect_same_bake(merge_shards(paths), bake(checkpoint_scene(), checkpoint_light(), options));
  }
}

TEST_F(ShardTest, TheDescriptionIsKept) {
  const fs::path path = bake_share("a", {1, 1}, checkpoint_options(), R"({"a":1})");
  EXPECT_EQ(read_shard_description(path), R"({"a":1})");
  EXPECT_EQ(merge_shards(std::vector{path}).map.metadata, R"({"a":1})");
}

TEST_F(ShardTest, AShardGoesOnFromItsCheckpoint) {
  const fs::path file = folder_.path() / "a.partial";
  const fs::path whole_shard = bake_share("whole", {1, 2});
  {
    Checkpoint checkpoint({file, 0, {}});
    bake_shard(checkpoint_scene(), checkpoint_light(), checkpoint_options(), {1, 2}, {}, folder_.path() / "a",
               {}, &checkpoint);
  }
  std::vector<std::byte> bytes = file_content(file);
  bytes.resize(bytes.size() / 2);
  put_file(file, bytes);
  std::vector<std::string> notices;
  Checkpoint checkpoint({file, 0, [&](const std::string& line) { notices.push_back(line); }});
  bake_shard(
      checkpoint_scene(), checkpoint_light(), checkpoint_options(), {1, 2},
      [](const BakedMap&) { return "{}"; }, folder_.path() / "a", {}, &checkpoint);
  EXPECT_TRUE(notices.empty());
  expect_same_bake(merge_shards(std::vector{folder_.path() / "a", bake_share("b", {2, 2})}), whole());
  // Another share is another part.
  bake_shard(checkpoint_scene(), checkpoint_light(), checkpoint_options(), {2, 2}, {}, folder_.path() / "c",
             {}, &checkpoint);
  EXPECT_EQ(notices.size(), 1U);
}

TEST_F(ShardTest, MissingAndDoubleOnesAreNamed) {
  std::vector<fs::path> paths = bake_shares(4);
  expect_refused({paths[0], paths[2]}, "shards: 2, 4 of 4 missing");
  expect_refused({paths[0], paths[1], paths[2], paths[1], paths[3]}, "2: is shard 2/4, as is 2");
  expect_refused({}, "shards: none is given");
}

TEST_F(ShardTest, WhatDoesNotBelongIsRefused) {
  const fs::path a = bake_share("a", {1, 2});
  BakeOptions other = checkpoint_options();
  other.seed = 3;
  expect_refused({a, bake_share("b", {2, 2}, other)}, "b: is of another bake than a");
  expect_refused({a, bake_share("b", {2, 2}, checkpoint_options(), R"({"b":2})")},
                 "b: is of another bake than a");
  expect_refused({a, bake_share("b", {2, 3})}, "b: is shard 2/3, where a is 1/2");
  put_file(folder_.path() / "text", std::as_bytes(std::span("text")));
  expect_refused({a, folder_.path() / "text"}, "text: is no shard of a bake");
  put_file(folder_.path() / "empty", {});
  expect_refused({a, folder_.path() / "empty"}, "empty: is no shard of a bake");
  static_cast<void>(bake_with(folder_.path() / "c", checkpoint_options()));
  expect_refused({folder_.path() / "c"}, "c: is unfinished: its bake has not come to its end");
}

TEST_F(ShardTest, DamageIsRefused) {
  const std::vector<std::byte> good = file_content(bake_share("a", {1, 1}));
  const fs::path path = folder_.path() / "damaged";
  const auto expect_input_error = [&](std::span<const std::byte> bytes) {
    put_file(path, bytes);
    try {
      static_cast<void>(merge_shards(std::vector{path}));
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input) << error.what();
    }
  };
  Random random(81);
  for (int n = 0; n < 60; ++n) {
    std::vector<std::byte> bytes = good;
    bytes[static_cast<std::size_t>(random.uniform(0, static_cast<double>(bytes.size())))] ^=
        static_cast<std::byte>(1 << n % 8);
    expect_input_error(bytes);
    expect_input_error(std::span(good).first(static_cast<std::size_t>(n) * good.size() / 60));
  }
  std::vector<std::byte> longer = good;
  longer.push_back({});
  expect_input_error(longer);
}

/// Good checksums over what no bake wrote.
TEST_F(ShardTest, LiesAreRefused) {
  const std::vector<std::byte> good = file_content(bake_share("a", {1, 1}));
  const auto scan = scan_part(good);
  ASSERT_TRUE(scan);
  const auto expect_lie_refused = [&](const std::function<void(std::vector<PartRecord>&)>& lie,
                                      const std::string& message) {
    std::vector<PartRecord> records = scan->records;
    lie(records);
    std::vector<std::byte> bytes;
    append_part_header(scan->header, bytes);
    for (const PartRecord& record : records) append_record(record.type, record.payload, bytes);
    put_file(folder_.path() / "lie", bytes);
    expect_refused({folder_.path() / "lie"}, message);
  };
  expect_lie_refused([](auto& r) { r.pop_back(); }, "lie: is unfinished: its bake has not come to its end");
  expect_lie_refused([](auto& r) { r.erase(r.begin()); }, "lie: does not describe its bake");
  expect_lie_refused([](auto& r) { r.insert(r.begin(), r[0]); }, "lie: describes its bake twice");
  expect_lie_refused([](auto& r) { r.erase(r.begin() + 1); }, "lie: does not hold the blocks that it counts");
  expect_lie_refused([](auto& r) { r[2] = r[1]; }, "lie: a block of it is in the shards twice");
  expect_lie_refused([](auto& r) { r[1].payload = r[1].payload.first(60); }, "lie: block 0 of it is damaged");
  expect_lie_refused([](auto& r) { r[0].payload = r[0].payload.first(300); },
                     "lie: the description of its bake is damaged");
  expect_lie_refused([](auto& r) { r.back().payload = r.back().payload.first(40); },
                     "lie: the last record is damaged");
}

/// A file of a few hundred bytes that claims to be of a map of 2^20 x 2^20 texels.
TEST_F(ShardTest, HugeClaimsAllocateNothing) {
  const std::vector<std::byte> good = file_content(bake_share("a", {1, 1}));
  const auto scan = scan_part(good);
  FactsRecord facts;
  std::vector<std::byte> claim(scan->records[0].payload.begin(), scan->records[0].payload.end());
  std::memcpy(&facts, claim.data(), sizeof facts);
  facts.width = facts.height = 1U << 20;
  std::memcpy(claim.data(), &facts, sizeof facts);
  const EndRecord end;
  std::vector<std::byte> bytes;
  append_part_header(scan->header, bytes);
  append_record(kBakeRecord, claim, bytes);
  append_record(kEndRecord, std::as_bytes(std::span(&end, 1)), bytes);
  put_file(folder_.path() / "huge", bytes);
  expect_refused({folder_.path() / "huge"}, "shards: do not hold as many blocks as the map has");
}

}  // namespace
}  // namespace pdsm::test
