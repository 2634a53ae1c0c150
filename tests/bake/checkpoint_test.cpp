// SPDX-License-Identifier: Apache-2.0
// Bakes that were stopped go on to the same bytes, whatever has become of their checkpoint.
#include "pdsm/bake/checkpoint.h"

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "file_size_limit.h"
#include "part/part_layout.h"
#include "part/part_records.h"
#include "scratch_folder.h"
#include "support/checkpoint_case.h"
#include "support/random.h"

namespace pdsm::test {
namespace {

using pdsm::testing::file_content;
using pdsm::testing::put_file;
using pdsm::testing::ScratchFolder;

class CheckpointTest : public ::testing::Test {
 protected:
  /// A bake that nothing disturbed; made once.
  static const BakedMap& whole() {
    static const BakedMap baked = bake(checkpoint_scene(), checkpoint_light(), checkpoint_options());
    return baked;
  }
  /// The checkpoint of a bake that came to its end but was not told that its result is safe.
  static const std::vector<std::byte>& full_checkpoint() {
    static const std::vector<std::byte> bytes = [] {
      const ScratchFolder folder;
      static_cast<void>(bake_with(folder.path() / "c", checkpoint_options()));
      return file_content(folder.path() / "c");
    }();
    return bytes;
  }
  /// Bakes with these bytes as the checkpoint.
  [[nodiscard]] Resumed resume_from(std::span<const std::byte> bytes) const {
    put_file(file(), bytes);
    return bake_with(file(), checkpoint_options());
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "map.partial"; }

  ScratchFolder folder_;
};

TEST_F(CheckpointTest, GoesOnAfterAnyNumberOfBlocks) {
  const auto scan = scan_part(full_checkpoint());
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->records.size(), 18U) << "nine blocks, and what their tiles took";
  for (std::size_t n = 1; n + 2 < scan->records.size(); n += 4) {
    const auto bytes =
        static_cast<std::uintmax_t>(scan->records[n].payload.data() - full_checkpoint().data());
    std::filesystem::remove(file());
    bake_until(file(), bytes);
    EXPECT_GE(std::filesystem::file_size(file()), bytes);
    const Resumed resumed = bake_with(file(), checkpoint_options());
    expect_same_bake(resumed.baked, whole());
    EXPECT_LT(resumed.baked.report.tiles, 9U);
    EXPECT_TRUE(resumed.notices.empty());
  }
}

TEST_F(CheckpointTest, AFinishedOneLeavesNothingToBake) {
  const Resumed resumed = resume_from(full_checkpoint());
  expect_same_bake(resumed.baked, whole());
  EXPECT_EQ(resumed.baked.report.tiles, 0U);
  EXPECT_EQ(resumed.baked.report.rays, whole().report.rays);
}

TEST_F(CheckpointTest, OtherThreadsTilesAndMemoryGoOnToo) {
  for (const std::uint32_t tile : {64U, 128U, 192U}) {
    std::filesystem::remove(file());
    bake_until(file(), full_checkpoint().size() / 2);
    BakeOptions options = checkpoint_options();
    options.tile = tile;
    options.threads = 3;
    options.memory /= 2;
    const Resumed resumed = bake_with(file(), options);
    expect_same_bake(resumed.baked, whole());
    EXPECT_TRUE(resumed.notices.empty());
  }
}

TEST_F(CheckpointTest, GoesOnSeveralTimes) {
  for (std::size_t n = 1; n < 5; ++n) bake_until(file(), n * full_checkpoint().size() / 6);
  expect_same_bake(bake_with(file(), checkpoint_options()).baked, whole());
}

TEST_F(CheckpointTest, ATornEndIsIgnored) {
  const std::vector<std::byte>& full = full_checkpoint();
  const auto scan = scan_part(full);
  for (std::size_t n = 0; n < scan->records.size(); n += 3) {
    const auto begin = static_cast<std::size_t>(scan->records[n].payload.data() - full.data());
    for (const std::size_t size : {begin - 25, begin - 1, begin, begin + 1}) {
      SCOPED_TRACE(size);
      const Resumed resumed = resume_from(std::span(full).first(size));
      expect_same_bake(resumed.baked, whole());
      // What was written behind the cut is whole again.
      EXPECT_EQ(scan_part(file_content(file()))->good_bytes, std::filesystem::file_size(file()));
    }
  }
}

TEST_F(CheckpointTest, DamageIsNoMoreThanLostWork) {
  Random random(71);
  for (int n = 0; n < 40; ++n) {
    SCOPED_TRACE(n);
    std::vector<std::byte> bytes = full_checkpoint();
    // Behind the magic, without which it is somebody else's file.
    const auto at = static_cast<std::size_t>(random.uniform(12, static_cast<double>(bytes.size())));
    bytes[at] ^= static_cast<std::byte>(1 << n % 8);
    expect_same_bake(resume_from(bytes).baked, whole());
  }
}

/// Records with good checksums that no bake wrote.
TEST_F(CheckpointTest, LiesAreNotBelieved) {
  const auto scan = scan_part(full_checkpoint());
  std::vector<std::byte> bytes;
  append_part_header(scan->header, bytes);
  append_record(kBlockRecord, {}, bytes);
  append_record(kTileRecord, {}, bytes);
  append_record(record_type("WHAT"), std::as_bytes(std::span("text")), bytes);
  Random random(72);
  for (const PartRecord& record : scan->records) {
    std::vector<std::byte> payload(record.payload.begin(), record.payload.end());
    for (int copy = 0; copy < 20; ++copy) {
      auto changed = payload;
      const auto at = static_cast<std::size_t>(random.uniform(0, 72));
      changed[at] ^= static_cast<std::byte>(1 << copy % 8);
      // A block may say that it is another one, of the same size: only its index would tell.
      if (record.type == kBlockRecord && at < 4) continue;
      // The counts of events and rays are taken on trust.
      if (record.type == kBlockRecord && at >= 8 && at < 24) continue;
      if (record.type == kTileRecord) continue;
      append_record(record.type, changed, bytes);
    }
  }
  const Resumed resumed = resume_from(bytes);
  expect_same_bake(resumed.baked, whole());
}

TEST_F(CheckpointTest, ABlockTwiceCountsOnce) {
  const auto scan = scan_part(full_checkpoint());
  std::vector<std::byte> bytes;
  append_part_header(scan->header, bytes);
  for (int copy = 0; copy < 2; ++copy) {
    for (std::size_t n = 0; n < 6; ++n) append_record(scan->records[n].type, scan->records[n].payload, bytes);
  }
  expect_same_bake(resume_from(bytes).baked, whole());
}

TEST_F(CheckpointTest, AnotherBakesIsReplacedWithANotice) {
  BakeOptions other = checkpoint_options();
  other.seed = 3;
  static_cast<void>(bake_with(file(), other));
  const Resumed resumed = bake_with(file(), checkpoint_options());
  expect_same_bake(resumed.baked, whole());
  EXPECT_EQ(resumed.baked.report.tiles, 9U);
  ASSERT_EQ(resumed.notices.size(), 1U);
  EXPECT_EQ(resumed.notices[0], file().string() + ": is of another bake, and is replaced");
  EXPECT_EQ(file_content(file()).size(), full_checkpoint().size());
}

TEST_F(CheckpointTest, SomebodyElsesFileIsLeftAlone) {
  const std::string text = "notes";
  put_file(file(), std::as_bytes(std::span(text)));
  const Resumed resumed = bake_with(file(), checkpoint_options());
  expect_same_bake(resumed.baked, whole());
  ASSERT_EQ(resumed.notices.size(), 1U);
  EXPECT_EQ(resumed.notices[0],
            file().string() + ": is no checkpoint, and is left alone; going on without a checkpoint");
  EXPECT_EQ(file_content(file()).size(), text.size());
}

TEST_F(CheckpointTest, WhatIsNoFileIsLeftAlone) {
  ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
  Resumed resumed = bake_with(file(), checkpoint_options());
  EXPECT_EQ(resumed.notices.size(), 1U);
  EXPECT_TRUE(std::filesystem::is_fifo(file()));
  std::filesystem::remove(file());
  std::filesystem::create_directory(file());
  resumed = bake_with(file(), checkpoint_options());
  EXPECT_EQ(resumed.notices.size(), 1U);
  std::filesystem::remove(file());
  std::filesystem::create_symlink("elsewhere", file());
  resumed = bake_with(file(), checkpoint_options());
  EXPECT_EQ(resumed.notices.size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "elsewhere"));
  expect_same_bake(resumed.baked, whole());
}

TEST_F(CheckpointTest, OneThatIsBeingWrittenIsLeftAlone) {
  put_file(file(), full_checkpoint());
  const int other = ::open(file().c_str(), O_RDWR);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  const Resumed resumed = bake_with(file(), checkpoint_options());
  ::close(other);
  expect_same_bake(resumed.baked, whole());
  EXPECT_EQ(resumed.baked.report.tiles, 9U);
  ASSERT_EQ(resumed.notices.size(), 1U);
  EXPECT_EQ(resumed.notices[0],
            file().string() + ": another bake is writing it; going on without a checkpoint");
  EXPECT_TRUE(file_content(file()) == full_checkpoint());
}

TEST_F(CheckpointTest, AFullDiskCostsTheCheckpointAlone) {
  Resumed resumed;
  for (const rlim_t room : {rlim_t{0}, rlim_t{20}, rlim_t{full_checkpoint().size() / 2}}) {
    SCOPED_TRACE(room);
    const pdsm::testing::FileSizeLimit limit(room);
    resumed = bake_with(file(), checkpoint_options());
    expect_same_bake(resumed.baked, whole());
    ASSERT_EQ(resumed.notices.size(), 1U);
    EXPECT_EQ(resumed.notices[0].rfind(file().string() + ": cannot write: ", 0), 0U) << resumed.notices[0];
    EXPECT_FALSE(std::filesystem::exists(file()));
  }
}

TEST_F(CheckpointTest, AShortBakeWritesNone) {
  {
    Checkpoint checkpoint({file(), 1e6, {}});
    expect_same_bake(bake(checkpoint_scene(), checkpoint_light(), checkpoint_options(), {}, &checkpoint),
                     whole());
  }
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(CheckpointTest, GoesWhenTheResultIsSafe) {
  put_file(file(), full_checkpoint());
  Checkpoint checkpoint({file(), 1e6, {}});
  static_cast<void>(bake(checkpoint_scene(), checkpoint_light(), checkpoint_options(), {}, &checkpoint));
  EXPECT_TRUE(std::filesystem::exists(file()));
  checkpoint.remove();
  EXPECT_TRUE(folder_.names().empty());
}

}  // namespace
}  // namespace pdsm::test
