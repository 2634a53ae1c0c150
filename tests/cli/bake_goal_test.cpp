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
  /// report.json, map.pdsm and `info` tell what was chosen and reached.
  void expect_records() const {
    const auto goal = nlohmann::json::parse(contents("report.json"))["goal"];
    EXPECT_EQ(goal["asked"], nlohmann::json({{"target_error", 0.04}, {"size_budget", 50U << 10}}));
    ASSERT_GE(goal["tries"].size(), 6U);
    for (const auto& each : goal["tries"]) {
      for (const char* key : {"purpose", "options", "error", "standard_error", "seconds", "bytes"}) {
        EXPECT_TRUE(each.contains(key)) << key;
      }
    }
    EXPECT_EQ(goal["chosen"]["epsilon"], 0.03);
    EXPECT_FALSE(goal["why"].get<std::string>().empty());
    const auto map = metadata();
    for (const char* key : {"samples", "resolution", "map_resolution", "epsilon"})
      EXPECT_EQ(map["options"][key], goal["chosen"][key]) << key;
    EXPECT_EQ(map["achieved"], goal["achieved"]);
    EXPECT_LE(map["achieved"]["mean_abs_error"], 0.04);
    const Outcome info = run({"info", "map.pdsm"});
    EXPECT_NE(info.out.find("achieved   mean_abs_error 0.0"), std::string::npos) << info.out;
  }
};

TEST_F(BakeGoal, TheGoalsHoldForWhoeverMeasures) {
  const std::vector<std::string> goals{"--target-error", "0.04", "--size-budget", "50K", "--epsilon", "0.03"};
  std::vector<std::string> arguments = goals;
  arguments.insert(arguments.end(), {"--threads", "2", "--report", "report.json"});
  const Outcome outcome = bake(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("key: "), std::string::npos) << outcome.err;
  EXPECT_LE(fs::file_size(path("map.pdsm")), 50U << 10);
  const Outcome verified =
      run({"verify", "map.pdsm", "one.scene.json", "--no-budget", "--max-error", "0.04", "--json"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  EXPECT_GE(nlohmann::json::parse(verified.out)["mean_abs_error"], 0.04 / 3);
  expect_records();

  // Another number of threads leads to the same bytes.
  const std::string two_threads = contents("map.pdsm");
  arguments = goals;
  arguments.insert(arguments.end(), {"--threads", "1", "--quiet"});
  ASSERT_EQ(bake(arguments).exit_code, 0);
  EXPECT_TRUE(contents("map.pdsm") == two_threads);
}

TEST_F(BakeGoal, LightsShareATimeBudget) {
  // Far more than is needed, with next to nothing left to choose: however slow the machine, it is enough.
  const Outcome outcome =
      run({"bake", "two.scene.json", "-o", "maps", "--time-budget", "2000", "--samples", "16", "--resolution",
           "32", "--map-resolution", "32", "--epsilon", "0.05", "--quiet", "--report", "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(contents("r.json"));
  for (const char* light : {"key", "lamp"}) {
    const auto goal = report[light]["goal"];
    EXPECT_LE(goal["asked"]["time_budget"], light == std::string("key") ? 1000.0 : 2000.0);
    EXPECT_GT(goal["seconds"]["predicted"], 0);
    EXPECT_GT(goal["seconds"]["actual"], 0);
    EXPECT_TRUE(exists(std::string("maps/") + light + ".pdsm"));
  }
}

TEST_F(BakeGoal, WhatCanNotBeReachedWritesNothing) {
  const std::vector<std::string> before = listing();
  const Outcome outcome = bake({"--target-error", "0.0005", "--time-budget", "0.5"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("--time-budget: ", 0), 0U) << outcome.err;
  EXPECT_EQ(listing(), before);
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
