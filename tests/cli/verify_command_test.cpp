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

TEST_F(VerifyCommand, BadFilesAreBadInput) {
  expect_exit(run({"verify", "plate.obj", "one.scene.json"}), 3);
  expect_exit(run({"verify", "map.pdsm", "plate.obj"}), 3);
  expect_exit(run({"verify", "map.pdsm", "missing.json"}), 3);
}

}  // namespace
}  // namespace pdsm
