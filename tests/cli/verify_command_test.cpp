// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "pdsm/format/map_file.h"
#include "scratch_scene.h"

namespace pdsm {
namespace {

class VerifyCommand : public ScratchScene {
 protected:
  VerifyCommand() { bake_small("map.pdsm"); }

  [[nodiscard]] Outcome verify(std::vector<std::string> extra) const {
    std::vector<std::string> arguments{"verify",    "map.pdsm", "one.scene.json", "--points", "400",
                                       "--samples", "256"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments);
  }
};

TEST_F(VerifyCommand, JsonHasItsKeys) {
  const Outcome outcome = verify({"--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto result = nlohmann::json::parse(outcome.out);
  for (const char* key : {"points", "shadowed_points", "mean_abs_error", "rms_error", "p99_error",
                          "max_error", "bias", "truth_standard_error", "past_end", "atty_error", "budget"}) {
    EXPECT_TRUE(result.contains(key)) << key;
  }
  EXPECT_EQ(result["points"], 400);
  EXPECT_GT(result["shadowed_points"], 0);
  EXPECT_GT(result["mean_abs_error"], 0);
  EXPECT_LE(result["mean_abs_error"], result["rms_error"]);
  EXPECT_LE(result["p99_error"], result["max_error"]);
  EXPECT_EQ(verify({"--json"}).out, outcome.out);
}

TEST_F(VerifyCommand, MaxErrorDecidesTheExitCode) {
  EXPECT_EQ(verify({"--max-error", "1"}).exit_code, 0);
  const Outcome above = verify({"--max-error", "0"});
  EXPECT_EQ(above.exit_code, 1);
  EXPECT_NE(above.out.find("mean abs error"), std::string::npos);
}

TEST_F(VerifyCommand, TheMapNamesItsLight) {
  // The scene's first light is another one: the map's own must be taken.
  std::string scene = contents("two.scene.json");
  const Outcome one = verify({"--json", "--no-budget"});
  const Outcome two = run({"verify", "map.pdsm", "two.scene.json", "--points", "400", "--samples", "256",
                           "--json", "--no-budget"});
  EXPECT_EQ(one.out, two.out);
  scene.replace(scene.find("\"key\""), 5, "\"kex\"");
  write_file("renamed.scene.json", scene);
  const Outcome missing = run({"verify", "map.pdsm", "renamed.scene.json"});
  expect_exit(missing, 3);
  EXPECT_NE(missing.err.find("'key'"), std::string::npos) << missing.err;
}

TEST_F(VerifyCommand, AMapOfALightThatStandsElsewhereIsRefused) {
  const std::string scene = contents("one.scene.json");
  const std::string direction = "\"direction\"", turned = "\"up\": [1, 0, 0], \"direction\"";
  std::string other = scene;
  other.replace(other.find(direction), direction.size(), turned);
  write_file("turned.scene.json", other);
  const Outcome outcome = run({"verify", "map.pdsm", "turned.scene.json"});
  expect_exit(outcome, 3);
  EXPECT_NE(outcome.err.find("map.pdsm:light: "), std::string::npos) << outcome.err;
}

TEST_F(VerifyCommand, BudgetHasItsKeysAndAddsUp) {
  const auto result = nlohmann::json::parse(verify({"--json"}).out);
  const auto& budget = result["budget"];
  double squares = 0;
  for (const char* part : {"sampling", "map", "fit", "quantisation", "filter"}) {
    ASSERT_TRUE(budget.contains(part)) << part;
    const double rms = budget[part];
    EXPECT_GT(rms, 0) << part;
    EXPECT_GE(rms, std::abs(budget["bias"][part].get<double>())) << part;
    squares += rms * rms;
  }
  EXPECT_NEAR(budget["root_sum_squares"], std::sqrt(squares), 1e-12);
  EXPECT_NEAR(budget["root_sum_squares_ratio"], std::sqrt(squares) / result["rms_error"].get<double>(),
              1e-12);
  // Biases are sums over the same points by the same number: they add up as the errors do.
  double bias = 0;
  for (const auto& part : budget["bias"]) bias += part.get<double>();
  EXPECT_NEAR(bias, result["bias"], 1e-12);
  EXPECT_LT(budget["telescoping_fault"], 1e-14);
  const Outcome text = verify({});
  EXPECT_NE(text.out.find("quantisation"), std::string::npos) << text.out;
}

TEST_F(VerifyCommand, NoBudgetLeavesItOutAndNothingElse) {
  const auto with = nlohmann::json::parse(verify({"--json"}).out);
  auto without = nlohmann::json::parse(verify({"--json", "--no-budget"}).out);
  EXPECT_FALSE(without.contains("budget"));
  without["budget"] = with["budget"];
  EXPECT_EQ(with, without);
  EXPECT_EQ(verify({"--no-budget"}).out.find("quantisation"), std::string::npos);
}

TEST_F(VerifyCommand, BudgetBakesAsTheMapWasBaked) {
  // With any other options than the map's, what is said to be rounding would be far more than that.
  const std::vector<std::vector<std::string>> various{
      {"--points", "jittered", "--seed", "5"},
      {"--walk", "midpoint", "--map-resolution", "64x16"},
      {"--receivers", "all", "--bias", "0.3", "--depth-tolerance", "0.2"},
      {"--receivers", "surfaces", "--epsilon", "0.2"},
      {"--epsilon", "0.1", "--mip-levels", "2"}};
  for (const std::vector<std::string>& options : various) {
    bake_small("map.pdsm", options);
    const auto result = nlohmann::json::parse(verify({"--json"}).out);
    const double points = result["points"], shadowed = result["shadowed_points"];
    EXPECT_LE(result["budget"]["quantisation"], std::sqrt(points / shadowed) / 255) << options[1];
  }
}

TEST_F(VerifyCommand, BudgetNeedsTheSceneOfTheBake) {
  EXPECT_EQ(verify({}).err, "");
  // What the light can't see is not what it was baked from.
  write_file("one.scene.json", contents("one.scene.json") + "\n");
  EXPECT_EQ(verify({}).err, "");
  write_file("plate.obj", "v -1 1 -1\nv -1 1 1\nv 1 1 1\nf 1 2 3\n");
  const Outcome refused = verify({});
  expect_exit(refused, 3);
  EXPECT_EQ(refused.err.find("map.pdsm:key: the scene has changed"), 0U) << refused.err;
  EXPECT_EQ(refused.out, "");
  const Outcome alone = verify({"--no-budget"});
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_NE(alone.err.find("the scene has changed"), std::string::npos) << alone.err;
}

TEST_F(VerifyCommand, BudgetNeedsTheOptionsOfTheBake) {
  PenumbraMap map = read_map(path("map.pdsm"));
  const auto metadata = nlohmann::json::parse(map.metadata);
  const auto expect_refused = [&](const nlohmann::json& changed) {
    map.metadata = changed.dump();
    write_map(map, path("map.pdsm"));
    const Outcome refused = verify({});
    expect_exit(refused, 3);
    EXPECT_EQ(refused.err.find("map.pdsm:options: "), 0U) << refused.err;
    EXPECT_EQ(verify({"--no-budget"}).exit_code, 0);
  };
  for (const char* key :
       {"samples", "resolution", "map_resolution", "epsilon", "walk", "receivers", "points", "seed"}) {
    auto changed = metadata;
    changed["options"].erase(key);
    expect_refused(changed);
  }
  auto changed = metadata;
  changed["options"]["walk"] = "random";
  expect_refused(changed);
  changed = metadata;
  changed["options"]["resolution"] = "32";
  expect_refused(changed);
  changed = metadata;
  changed.erase("depth_tolerance");
  expect_refused(changed);
  expect_refused(nlohmann::json::object());
}

TEST_F(VerifyCommand, HeatMapShowsTheWindow) {
  const Outcome plain = verify({"--no-budget"});
  EXPECT_EQ(verify({"--no-budget", "--heat-map", "error.png"}).out, plain.out);
  EXPECT_EQ(contents("error.png").substr(1, 3), "PNG");
  ASSERT_EQ(verify({"--no-budget", "--heat-map", "error.exr", "--heat-map-samples", "16"}).exit_code, 0);
  EXPECT_EQ(contents("error.exr").substr(0, 4), "\x76\x2f\x31\x01");

  std::filesystem::create_symlink("map.pdsm", path("map.png"));
  const auto before = listing();
  const std::string map = contents("map.pdsm");
  expect_exit(verify({"--heat-map", "map.png"}), 2);
  EXPECT_EQ(contents("map.pdsm"), map);
  expect_exit(verify({"--heat-map", "error.jpg"}), 2);
  expect_exit(verify({"--heat-map", "map.pdsm"}), 2);
  expect_exit(verify({"--heat-map", "nowhere/error.png"}), 4);
  expect_exit(verify({"--heat-map-samples", "0"}), 2);
  EXPECT_EQ(listing(), before);
}

TEST_F(VerifyCommand, AMapForSurfacesIsMeasuredOnSurfaces) {
  bake_small("surfaces.pdsm", {"--receivers", "surfaces"});
  const Outcome outcome =
      run({"verify", "surfaces.pdsm", "one.scene.json", "--points", "400", "--samples", "256"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("(400 on surfaces"), std::string::npos) << outcome.out;
}

TEST_F(VerifyCommand, BadFilesAreBadInput) {
  expect_exit(run({"verify", "plate.obj", "one.scene.json"}), 3);
  expect_exit(run({"verify", "map.pdsm", "plate.obj"}), 3);
  expect_exit(run({"verify", "map.pdsm", "missing.json"}), 3);
}

}  // namespace
}  // namespace pdsm
