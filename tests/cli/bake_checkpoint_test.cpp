// SPDX-License-Identifier: Apache-2.0
// `pdsm bake` that was stopped goes on, and ends with the same file.
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

#include "scratch_scene.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

/// A tile for each block of 64 x 64 texels.
const std::vector<std::string> kBake{"bake", "one.scene.json", "-o", "map.pdsm", "--tile", "64"};

class BakeCheckpoint : public ScratchScene {
 protected:
  [[nodiscard]] static std::vector<std::string> bake_with(const std::vector<std::string>& extra) {
    std::vector<std::string> arguments = kBake;
    arguments.insert(arguments.end(), {"--resolution", "192", "--samples", "32"});
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return arguments;
  }
  /// What an undisturbed bake writes.
  [[nodiscard]] std::string undisturbed() const {
    const Outcome outcome = run(bake_with({"--no-checkpoint"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::string bytes = contents("map.pdsm");
    fs::remove(path("map.pdsm"));
    return bytes;
  }
  /// Leaves what a bake does that writes its checkpoint at once and dies in the middle of that, as by
  /// SIGKILL, when it has so many bytes.
  void kill_bake(std::uint64_t bytes) const {
    // With less, LLVM's OpenMP ends the process as it starts: it writes a kilobyte of its own.
    constexpr std::uint64_t kLeastLimit = 2000;
    RunSetup setup;
    setup.file_limit = std::max(bytes, kLeastLimit);
    EXPECT_EQ(run(bake_with({"--checkpoint", "0"}), setup).exit_code, 128 + SIGXFSZ);
    EXPECT_EQ(fs::file_size(path("map.pdsm.partial")), setup.file_limit);
    fs::resize_file(path("map.pdsm.partial"), bytes);
  }
};

TEST_F(BakeCheckpoint, KilledBakesGoOn) {
  const std::string whole = undisturbed();
  for (const std::uint64_t bytes : {1U, 500U, 3000U}) {
    SCOPED_TRACE(bytes);
    write_file("map.pdsm", "old");
    kill_bake(bytes);
    EXPECT_EQ(contents("map.pdsm"), "old");
    const Outcome resumed = run(bake_with({"--threads", "1"}));
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(resumed.err.find("partial"), std::string::npos) << resumed.err;
    EXPECT_TRUE(contents("map.pdsm") == whole);
    EXPECT_FALSE(exists("map.pdsm.partial"));
    // A killed process can't remove its temporary file.
    for (const std::string& name : listing()) {
      if (name.starts_with(".pdsm-")) fs::remove(path(name));
    }
  }
}

TEST_F(BakeCheckpoint, InterruptedBakesGoOn) {
  write_file("map.pdsm", "old");
  std::vector<std::string> expected = listing();
  // Far more than can be baked before the signal comes.
  std::vector<std::string> long_bake = kBake;
  long_bake.insert(long_bake.end(), {"--samples", "4096", "--resolution", "4096", "--checkpoint", "0"});
  std::uintmax_t kept = 0;
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningPdsm baking(long_bake, path(""));
    ASSERT_TRUE(baking.wait_for_file(path("map.pdsm.partial"), kept + 1));
    baking.send(signal);
    EXPECT_EQ(baking.wait(), 130);
    // The second went on with the first one's file.
    EXPECT_GT(fs::file_size(path("map.pdsm.partial")), kept);
    kept = fs::file_size(path("map.pdsm.partial"));
    EXPECT_EQ(contents("map.pdsm"), "old");
  }
  expected.emplace_back("map.pdsm.partial");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(listing(), expected);
}

TEST_F(BakeCheckpoint, AnotherBakesIsReplacedAndGoes) {
  kill_bake(1000);
  const Outcome other =
      run({"bake", "one.scene.json", "-o", "map.pdsm", "--samples", "16", "--resolution", "64"});
  EXPECT_EQ(other.exit_code, 0);
  EXPECT_EQ(other.err.rfind("warning: map.pdsm.partial: is of another bake, and is replaced\n", 0), 0U)
      << other.err;
  EXPECT_FALSE(exists("map.pdsm.partial"));
}

// A bake may be killed between writing its map and removing its checkpoint.
TEST_F(BakeCheckpoint, OneBesideItsMapGoes) {
  kill_bake(3000);
  const std::string left = contents("map.pdsm.partial");
  ASSERT_EQ(run(bake_with({})).exit_code, 0);
  const std::string map = contents("map.pdsm");
  write_file("map.pdsm.partial", left);
  const Outcome unchanged = run(bake_with({}));
  EXPECT_NE(unchanged.err.find("unchanged"), std::string::npos) << unchanged.err;
  EXPECT_FALSE(exists("map.pdsm.partial"));
  EXPECT_TRUE(contents("map.pdsm") == map);
  // That of another bake of the same name does not.
  ASSERT_EQ(run(bake_with({"--seed", "3", "--force"})).exit_code, 0);
  write_file("map.pdsm.partial", left);
  ASSERT_EQ(run(bake_with({"--seed", "3"})).exit_code, 0);
  EXPECT_TRUE(contents("map.pdsm.partial") == left);
}

TEST_F(BakeCheckpoint, NoCheckpointNeitherReadsNorWrites) {
  write_file("map.pdsm.partial", "not ours");
  const Outcome outcome = run(bake_with({"--no-checkpoint"}));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.find("partial"), std::string::npos) << outcome.err;
  EXPECT_EQ(contents("map.pdsm.partial"), "not ours");
  expect_exit(run(bake_with({"--no-checkpoint", "--checkpoint", "1"})), 2);
}

TEST_F(BakeCheckpoint, TwoBakersOneWholeWinner) {
  const std::string whole = undisturbed();
  RunningPdsm first(bake_with({"--checkpoint", "0"}), path("")),
      second(bake_with({"--checkpoint", "0"}), path(""));
  EXPECT_EQ(first.wait(), 0);
  EXPECT_EQ(second.wait(), 0);
  EXPECT_TRUE(contents("map.pdsm") == whole);
  EXPECT_FALSE(exists("map.pdsm.partial"));
}

TEST_F(BakeCheckpoint, ALockedOneIsLeftToItsOwner) {
  const std::string whole = undisturbed();
  write_file("map.pdsm.partial", "");
  const int owner = open(path("map.pdsm.partial").c_str(), O_RDWR);
  ASSERT_EQ(flock(owner, LOCK_EX), 0);
  const Outcome outcome = run(bake_with({}));
  close(owner);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("map.pdsm.partial: another bake is writing it"), std::string::npos)
      << outcome.err;
  EXPECT_TRUE(exists("map.pdsm.partial"));
  EXPECT_TRUE(contents("map.pdsm") == whole);
}

}  // namespace
}  // namespace pdsm
