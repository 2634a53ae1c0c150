// SPDX-License-Identifier: Apache-2.0
#include <signal.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class TradeoffCommand : public ScratchScene {
 protected:
  TradeoffCommand() {
    std::string scene = contents("one.scene.json");
    const std::string width = "\"width\": 1";
    scene.replace(scene.find(width), width.size(), width + ", \"resolution\": 48, \"samples\": 32");
    write_file("small.scene.json", scene);
  }

  [[nodiscard]] Outcome tradeoff(const std::string& scene, std::vector<std::string> extra = {},
                                 RunSetup setup = {}) const {
    std::vector<std::string> arguments{
        "tradeoff", scene, "-o", "out", "--effort", "quick", "--points", "200", "--truth-samples", "64"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments, setup);
  }
};

TEST_F(TradeoffCommand, WritesTablesPlotsAndOnePage) {
  const Outcome outcome = tradeoff("small.scene.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("0 outside their tube"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("(0 from an earlier run)"), std::string::npos) << outcome.out;
  for (const char* name :
       {"out/tradeoff.csv", "out/tradeoff.json", "out/index.html", "out/plots/error-time.svg",
        "out/plots/factors.gp", "out/pictures/truth.png", "out/pictures/default.png"})
    EXPECT_TRUE(exists(name)) << name;
  const auto json = nlohmann::json::parse(contents("out/tradeoff.json"));
  const std::size_t count = json["measurements"].size();
  EXPECT_GT(count, 20U);

  // The page needs nothing but itself.
  const std::string page = contents("out/index.html");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(page.find("data:image/svg+xml"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("href="), std::string::npos);
  for (std::size_t at = page.find("src="); at != std::string::npos; at = page.find("src=", at + 1))
    ASSERT_EQ(page.substr(at, 10), "src=\"data:") << page.substr(at, 80);

  // A second run has nothing left to measure.
  const Outcome again = tradeoff("small.scene.json");
  EXPECT_NE(again.out.find("(" + std::to_string(count) + " from an earlier run)"), std::string::npos)
      << again.out;
}

TEST_F(TradeoffCommand, AnInterruptedSweepGoesOn) {
  RunningPdsm sweep({"tradeoff", "one.scene.json", "-o", "out", "--effort", "quick", "--points", "100",
                     "--truth-samples", "16"},
                    path(""));
  ASSERT_TRUE(sweep.wait_for_handler(SIGINT));
  ASSERT_TRUE(sweep.wait_for_cpu_seconds(1));
  sweep.send(SIGINT);
  EXPECT_EQ(sweep.wait(), 130);
  EXPECT_TRUE(exists("out/journal.jsonl"));
  EXPECT_FALSE(exists("out/index.html"));
}

TEST_F(TradeoffCommand, WithoutGnuplotItSaysSoBeforeItBegins) {
  const std::string path_before = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const Outcome outcome = tradeoff("small.scene.json");
  setenv("PATH", path_before.c_str(), 1);
  expect_exit(outcome, 4);
  EXPECT_NE(outcome.err.find("gnuplot"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("out"));
}

TEST_F(TradeoffCommand, RefusesFoldersThatItCantUse) {
  expect_exit(run({"tradeoff", "small.scene.json", "-o", "missing/out"}), 4);
  expect_exit(run({"tradeoff", "small.scene.json", "-o", "plate.obj"}), 2);
  std::filesystem::create_directory(path("locked"));
  std::filesystem::permissions(path("locked"), std::filesystem::perms::owner_read);
  RunSetup nobody;
  nobody.unprivileged = true;
  expect_exit(run({"tradeoff", "small.scene.json", "-o", "locked"}, nobody), 4);
  // What would be written over is an input.
  write_file("index.html", "v 0 0 0\n");
  std::string scene = contents("small.scene.json");
  scene.replace(scene.find("plate.obj"), 9, "index.html");
  write_file("over.scene.json", scene);
  expect_exit(run({"tradeoff", "over.scene.json", "-o", "."}), 2);
}

TEST_F(TradeoffCommand, RefusesWhatItDoesNotKnow) {
  expect_exit(run({"tradeoff", "small.scene.json"}), 2);
  expect_exit(tradeoff("small.scene.json", {"--effort", "some"}), 2);
  expect_exit(tradeoff("small.scene.json", {"--points", "0"}), 2);
  expect_exit(tradeoff("small.scene.json", {"--light", "none"}), 2);
  expect_exit(tradeoff("two.scene.json"), 2);
  expect_exit(tradeoff("missing.scene.json"), 3);
}

}  // namespace
}  // namespace pdsm
