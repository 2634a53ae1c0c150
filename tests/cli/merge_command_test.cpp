// SPDX-License-Identifier: Apache-2.0
// `pdsm bake --shard` and `pdsm merge`.
#include <signal.h>

#include <nlohmann/json.hpp>

#include "scratch_scene.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

class MergeCommand : public ScratchScene {
 protected:
  /// 3 x 2 blocks, with mip levels.
  [[nodiscard]] Outcome bake(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"bake", "one.scene.json"});
    arguments.insert(arguments.end(),
                     {"--samples", "16", "--resolution", "160x128", "--mip-levels", "3", "--quiet"});
    return run(arguments);
  }
  void bake_shard(const std::string& share, const std::string& output,
                  std::vector<std::string> extra = {}) const {
    extra.insert(extra.begin(), {"--shard", share, "-o", output});
    const Outcome outcome = bake(extra);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  void expect_refused(const Outcome& outcome, int code, const std::string& begin) const {
    expect_exit(outcome, code);
    EXPECT_EQ(outcome.err.rfind(begin, 0), 0U) << outcome.err;
    EXPECT_FALSE(exists("x.pdsm"));
  }
};

TEST_F(MergeCommand, GivesTheBytesOfOneBake) {
  ASSERT_EQ(bake({"-o", "whole.pdsm", "--report", "whole.json"}).exit_code, 0);
  bake_shard("1/3", "a.shard", {"--threads", "1"});
  bake_shard("2/3", "b.shard", {"--tile", "64"});
  bake_shard("3/3", "c.shard");
  const std::vector<std::string> before = listing();
  const Outcome outcome =
      run({"merge", "c.shard", "a.shard", "b.shard", "-o", "map.pdsm", "--report", "map.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_TRUE(contents("map.pdsm") == contents("whole.pdsm"));
  EXPECT_EQ(listing().size(), before.size() + 2);
  // The report is the same but for what depends on the run: seconds, memory, rays on tiles' margins.
  auto whole = nlohmann::json::parse(contents("whole.json")),
       merged = nlohmann::json::parse(contents("map.json"));
  for (auto* report : {&whole, &merged}) {
    report->erase("seconds");
    report->erase("rays");
    (*report)["bytes"].erase("peak_memory");
    (*report)["bytes"].erase("resident_after_bvh");
  }
  EXPECT_EQ(merged, whole);
}

TEST_F(MergeCommand, NamesWhatDiffers) {
  bake_shard("1/2", "a.shard");
  bake_shard("2/2", "b.shard", {"--seed", "3"});
  expect_refused(run({"merge", "a.shard", "b.shard", "-o", "x.pdsm"}), 3, "b.shard:options.seed: ");
  bake_shard("2/2", "b.shard", {"--epsilon", "0.05"});
  expect_refused(run({"merge", "a.shard", "b.shard", "-o", "x.pdsm"}), 3, "b.shard:options.epsilon: ");
  bake_shard("2/2", "b.shard", {"--isa", "sse2"});
  expect_refused(run({"merge", "a.shard", "b.shard", "-o", "x.pdsm"}), 3, "b.shard:isa: ");
  std::string scene = contents("one.scene.json");
  scene.insert(scene.find("\"floor.obj\"") + 11, ", \"casts\": false");
  write_file("one.scene.json", scene);
  bake_shard("2/2", "b.shard");
  expect_refused(run({"merge", "a.shard", "b.shard", "-o", "x.pdsm"}), 3, "b.shard:key: ");
  fs::copy_file(path("two.scene.json"), path("one.scene.json"), fs::copy_options::overwrite_existing);
  bake_shard("1/2", "a.shard", {"--light", "key"});
  bake_shard("2/2", "b.shard", {"--light", "lamp"});
  expect_refused(run({"merge", "a.shard", "b.shard", "-o", "x.pdsm"}), 3, "b.shard:light.name: ");
}

TEST_F(MergeCommand, NamesWhatIsMissingDoubleOrNoShard) {
  bake_shard("1/4", "a.shard");
  bake_shard("3/4", "c.shard");
  expect_refused(run({"merge", "a.shard", "c.shard", "-o", "x.pdsm"}), 3, "shards: 2, 4 of 4 missing");
  expect_refused(run({"merge", "a.shard", "c.shard", "a.shard", "-o", "x.pdsm"}), 3, "a.shard: is shard 1/4");
  expect_refused(run({"merge", "a.shard", "floor.obj", "-o", "x.pdsm"}), 3, "floor.obj: is no shard");
  expect_refused(run({"merge", "a.shard", "missing", "-o", "x.pdsm"}), 3, "missing: ");
  const std::string whole = contents("a.shard");
  write_file("a.shard", whole.substr(0, whole.size() - 1));
  expect_refused(run({"merge", "a.shard", "-o", "x.pdsm"}), 3, "a.shard:offset ");
}

TEST_F(MergeCommand, FailureKeepsTheOldFile) {
  bake_shard("1/1", "a.shard");
  const std::string shard = contents("a.shard");
  write_file("old.pdsm", "old");
  expect_exit(run({"merge", "a.shard", "floor.obj", "-o", "old.pdsm"}), 3);
  EXPECT_EQ(contents("old.pdsm"), "old");
  expect_exit(run({"merge", "a.shard", "-o", "a.shard"}), 2);
  expect_exit(run({"merge", "a.shard", "-o", "y.pdsm", "--report", "a.shard"}), 2);
  expect_exit(run({"merge", "a.shard", "-o", "y.pdsm", "--report", "./y.pdsm"}), 2);
  expect_exit(run({"merge", "a.shard", "-o", "missing/y.pdsm"}), 4);
  RunSetup full;
  full.file_limit = 500;
  EXPECT_EQ(run({"merge", "a.shard", "-o", "old.pdsm"}, full).exit_code, 128 + SIGXFSZ);
  EXPECT_EQ(contents("old.pdsm"), "old");
  EXPECT_TRUE(contents("a.shard") == shard);
}

TEST_F(MergeCommand, SharesThatMakeNoSenseAreUsageErrors) {
  for (const char* share : {"0/2", "3/2", "2", "1/0", "1/2/3", "a/b", "-1/2", "1/70000", "1/", "/2", ""}) {
    expect_refused(bake({"-o", "x.pdsm", "--shard", share}), 2, "--shard: ");
  }
  expect_refused(bake({"-o", "x.pdsm", "--shard", "1/7"}), 2, "--shard: the map has only 6 blocks");
  expect_refused(bake({"-o", "x.pdsm", "--shard", "1/2", "--report", "r.json"}), 2, "--report: ");
  expect_refused(bake({"-o", "x.pdsm", "--shard", "1/2", "--dry-run"}), 2, "--shard: ");
  expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--shard", "1/2", "--size-budget", "1M"}), 2,
                 "--shard: ");
  expect_refused(run({"bake", "two.scene.json", "-o", "x.pdsm", "--shard", "1/2"}), 2, "--light: ");
}

TEST_F(MergeCommand, AKilledShardGoesOn) {
  bake_shard("2/2", "whole.shard", {"--tile", "64"});
  RunSetup setup;
  setup.file_limit = 2000;
  const Outcome killed =
      run({"bake", "one.scene.json", "--samples", "16", "--resolution", "160x128", "--mip-levels", "3",
           "--shard", "2/2", "-o", "b.shard", "--checkpoint", "0", "--tile", "64"},
          setup);
  EXPECT_EQ(killed.exit_code, 128 + SIGXFSZ);
  EXPECT_FALSE(exists("b.shard"));
  EXPECT_EQ(fs::file_size(path("b.shard.partial")), 2000U);
  bake_shard("2/2", "b.shard");
  EXPECT_FALSE(exists("b.shard.partial"));
  bake_shard("1/2", "a.shard");
  ASSERT_EQ(run({"merge", "a.shard", "b.shard", "-o", "b.pdsm"}).exit_code, 0);
  ASSERT_EQ(run({"merge", "a.shard", "whole.shard", "-o", "whole.pdsm"}).exit_code, 0);
  EXPECT_TRUE(contents("b.pdsm") == contents("whole.pdsm"));
}

}  // namespace
}  // namespace pdsm
