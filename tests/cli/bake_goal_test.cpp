// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "pdsm/format/map_file.h"
#include "scratch_scene.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

class BakeGoal : public ScratchScene {
 protected:
  [[nodiscard]] Outcome bake(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"bake", "one.scene.json", "-o", "map.pdsm"});
    return run(arguments);
  }
  [[nodiscard]] nlohmann::json metadata() const {
    return nlohmann::json::parse(read_map(path("map.pdsm")).metadata);
  }
};

TEST_F(BakeGoal, TheTargetHoldsForWhoeverMeasures) {
  const Outcome outcome = bake({"--target-error", "0.03", "--report", "report.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("key: "), std::string::npos) << outcome.err;
  for (const std::string seed : {"0", "1"}) {
    const Outcome verified = run({"verify", "map.pdsm", "one.scene.json", "--seed", seed, "--no-budget",
                                  "--max-error", "0.03", "--json"});
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    EXPECT_GE(nlohmann::json::parse(verified.out)["mean_abs_error"], 0.01);
  }
}

TEST_F(BakeGoal, TheRecordsTellWhatWasChosen) {
  ASSERT_EQ(
      bake({"--target-error", "0.04", "--epsilon", "0.03", "--quiet", "--report", "report.json"}).exit_code,
      0);
  const auto goal = nlohmann::json::parse(contents("report.json"))["goal"];
  EXPECT_EQ(goal["asked"], nlohmann::json({{"target_error", 0.04}}));
  ASSERT_GE(goal["tries"].size(), 5U);
  for (const auto& each : goal["tries"]) {
    for (const char* key : {"purpose", "options", "error", "standard_error", "seconds", "bytes"}) {
      EXPECT_TRUE(each.contains(key)) << key;
    }
  }
  EXPECT_EQ(goal["chosen"]["epsilon"], 0.03);
  EXPECT_FALSE(goal["why"].get<std::string>().empty());
  // The map tells the same, and what was measured.
  const auto map = metadata();
  EXPECT_EQ(map["options"]["samples"], goal["chosen"]["samples"]);
  EXPECT_EQ(map["options"]["resolution"], goal["chosen"]["resolution"]);
  EXPECT_EQ(map["options"]["epsilon"], 0.03);
  EXPECT_EQ(map["achieved"], goal["achieved"]);
  EXPECT_LE(map["achieved"]["mean_abs_error"], 0.04);
  const Outcome info = run({"info", "map.pdsm"});
  EXPECT_NE(info.out.find("achieved   mean_abs_error 0.0"), std::string::npos) << info.out;
}

TEST_F(BakeGoal, ThreadsDoNotDecide) {
  for (const std::vector<std::string>& goal :
       {std::vector<std::string>{"--target-error", "0.05"}, {"--size-budget", "12K"}}) {
    std::vector<std::string> arguments{goal[0], goal[1], "--quiet", "--threads", "1"};
    ASSERT_EQ(bake(arguments).exit_code, 0);
    const std::string one = contents("map.pdsm");
    arguments.back() = "2";
    ASSERT_EQ(bake(arguments).exit_code, 0);
    EXPECT_TRUE(contents("map.pdsm") == one) << goal[0];
  }
}

TEST_F(BakeGoal, TheFileIsNeverLarger) {
  for (const auto& [text, bytes] : {std::pair("7000", 7000U), std::pair("20K", 20U << 10)}) {
    const Outcome outcome = bake({"--size-budget", text, "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_LE(fs::file_size(path("map.pdsm")), bytes);
  }
}

TEST_F(BakeGoal, TimeIsAGoal) {
  const Outcome outcome = bake({"--time-budget", "4", "--report", "report.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto goal = nlohmann::json::parse(contents("report.json"))["goal"];
  EXPECT_GT(goal["seconds"]["predicted"], 0);
  EXPECT_GT(goal["seconds"]["actual"], 0);
  EXPECT_TRUE(metadata().contains("achieved"));
}

TEST_F(BakeGoal, WhatCanNotBeReachedWritesNothing) {
  // Each with the goal that is in the way.
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"--target-error", {"--target-error", "0.005", "--resolution", "16"}},
      {"--size-budget", {"--size-budget", "2100"}},
      {"--size-budget", {"--target-error", "0.01", "--size-budget", "3K"}},
      {"--time-budget", {"--target-error", "0.005", "--time-budget", "0.1"}}};
  const std::vector<std::string> before = listing();
  for (const auto& [goal, goals] : cases) {
    const Outcome outcome = bake(goals);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind(goal + ": ", 0), 0U) << outcome.err;
    EXPECT_EQ(listing(), before);
  }
}

TEST_F(BakeGoal, EachLightHasItsOwnChoice) {
  ASSERT_EQ(
      run({"bake", "two.scene.json", "-o", "maps", "--target-error", "0.05", "--quiet", "--report", "r.json"})
          .exit_code,
      0);
  const auto report = nlohmann::json::parse(contents("r.json"));
  for (const char* light : {"key", "lamp"}) {
    EXPECT_LE(report[light]["goal"]["achieved"]["mean_abs_error"], 0.05) << light;
    EXPECT_TRUE(exists(std::string("maps/") + light + ".pdsm"));
  }
}

TEST_F(BakeGoal, QualityNamesOptions) {
  ASSERT_EQ(bake({"--quality", "draft", "--samples", "16", "--quiet"}).exit_code, 0);
  const auto draft = metadata();
  EXPECT_EQ(draft["options"]["resolution"], (std::vector<int>{256, 256}));
  EXPECT_EQ(draft["options"]["epsilon"], 0.04);
  EXPECT_EQ(draft["options"]["samples"], 16);  // what is said counts more than what is named
  EXPECT_FALSE(draft.contains("achieved"));
}

TEST_F(BakeGoal, FaultsAreUsage) {
  for (const std::string option : {"--target-error", "--time-budget", "--size-budget"}) {
    for (const std::string value : {"0", "-1", "nan", "inf", "2x", "", "1e"}) {
      const Outcome outcome = bake({option, value});
      expect_exit(outcome, 2);
      EXPECT_EQ(outcome.err.rfind(option + ": ", 0), 0U) << outcome.err;
    }
  }
  expect_exit(bake({"--target-error", "1.5"}), 2);
  expect_exit(bake({"--quality", "best"}), 2);
  expect_exit(bake({"--quality", "draft", "--target-error", "0.01"}), 2);
  expect_exit(bake({"--dry-run", "--size-budget", "2M"}), 2);
  EXPECT_FALSE(exists("map.pdsm"));
}

}  // namespace
}  // namespace pdsm
