// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

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
                          "max_error", "bias", "truth_standard_error", "past_end"}) {
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
  const Outcome one = verify({"--json"});
  const Outcome two =
      run({"verify", "map.pdsm", "two.scene.json", "--points", "400", "--samples", "256", "--json"});
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

TEST_F(VerifyCommand, WarnsWhenTheSceneHasChanged) {
  EXPECT_EQ(verify({}).err, "");
  write_file("one.scene.json", contents("one.scene.json") + "\n");
  const Outcome outcome = verify({});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("the scene has changed"), std::string::npos) << outcome.err;
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
