// SPDX-License-Identifier: Apache-2.0
// Two panes over a floor, one above the other, through all commands that look at them.
#include <nlohmann/json.hpp>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class TranslucencyCommand : public ScratchScene {
 protected:
  TranslucencyCommand() {
    auto scene = nlohmann::json::parse(contents("one.scene.json"));
    scene["geometry"] = {{{"file", "floor.obj"}},
                         {{"file", "plate.obj"}, {"opacity", 0.4}},
                         {{"file", "plate.obj"}, {"translate", {0, 0.5, 0}}, {"opacity", 0.5}}};
    write_file("panes.scene.json", scene.dump());
  }

  [[nodiscard]] Outcome bake(std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"bake", "panes.scene.json", "-o", "map.pdsm", "--samples",
                                       "64",   "--resolution",     "96", "--quiet"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments);
  }
};

TEST_F(TranslucencyCommand, FromBakeToError) {
  ASSERT_EQ(bake({"--report", "report.json"}).exit_code, 0);
  bool named = false;
  const auto report = nlohmann::json::parse(contents("report.json"));
  for (const auto& feature : report["modelled"])
    named = named || (feature["feature"] == "translucency" && feature["modelled"] == true);
  EXPECT_TRUE(named);
  // Below the middle of both all of the light comes through both: 1 - 0.6 x 0.5. Between them, through one.
  for (const auto& [point, expected] : {std::pair{"0 0.01 0", 0.7}, {"0 1.25 0", 0.5}, {"0 2 0", 0.0}}) {
    EXPECT_NEAR(value({"query", "map.pdsm"}, point), expected, 0.02) << point;
    EXPECT_NEAR(value({"truth", "panes.scene.json", "--samples", "256"}, point), expected, 1e-9) << point;
  }
  // As of opaque ones (cutouts_command_test.cpp); the budget bakes without fit.
  const Outcome verified = run({"verify", "map.pdsm", "panes.scene.json", "--points", "400", "--samples",
                                "256", "--max-error", "0.09", "--json"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  const auto result = nlohmann::json::parse(verified.out);
  EXPECT_GT(result["shadowed_points"], 50);
  EXPECT_TRUE(result.contains("budget"));
}

TEST_F(TranslucencyCommand, MergedShardsAreTheBake) {
  ASSERT_EQ(bake({"--mip-levels", "2"}).exit_code, 0);
  const std::string whole = contents("map.pdsm");
  for (const std::string share : {"1", "2"})
    ASSERT_EQ(run({"bake", "panes.scene.json", "-o", share + ".shard", "--shard", share + "/2", "--samples",
                   "64", "--resolution", "96", "--mip-levels", "2", "--tile", "64", "--quiet"})
                  .exit_code,
              0);
  ASSERT_EQ(run({"merge", "1.shard", "2.shard", "-o", "merged.pdsm", "--quiet"}).exit_code, 0);
  EXPECT_TRUE(contents("merged.pdsm") == whole);
}

TEST_F(TranslucencyCommand, AnotherOpacityIsAnotherMap) {
  ASSERT_EQ(bake().exit_code, 0);
  const std::string first = contents("map.pdsm");
  std::string scene = contents("panes.scene.json");
  scene.replace(scene.find("0.4"), 3, "0.6");
  write_file("panes.scene.json", scene);
  ASSERT_EQ(bake().exit_code, 0);
  EXPECT_FALSE(contents("map.pdsm") == first);
  EXPECT_NEAR(value({"query", "map.pdsm"}, "0 0.01 0"), 0.8, 0.02);
}

TEST_F(TranslucencyCommand, LosslessIsRefused) {
  const Outcome outcome = bake({"--epsilon", "0"});
  expect_exit(outcome, 2);
  EXPECT_EQ(outcome.err.rfind("--epsilon: ", 0), 0U) << outcome.err;
  EXPECT_EQ(bake({"--epsilon", "3.1e-5"}).exit_code, 0);
  EXPECT_EQ(bake({"--dry-run"}).exit_code, 0);
}

}  // namespace
}  // namespace pdsm
