// SPDX-License-Identifier: Apache-2.0
// A ruby pane over a floor, through all commands that look at it.
#include <nlohmann/json.hpp>
#include <sstream>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class ChannelsCommand : public ScratchScene {
 protected:
  ChannelsCommand() {
    auto scene = nlohmann::json::parse(contents("one.scene.json"));
    scene["geometry"] = {{{"file", "floor.obj"}},
                         {{"file", "plate.obj"}, {"transmission", {0.9, 0.25, 0}}},
                         {{"file", "plate.obj"}, {"translate", {0, 0.5, 0}}, {"opacity", 0.5}}};
    write_file("ruby.scene.json", scene.dump());
  }

  void bake() const {
    ASSERT_EQ(run({"bake", "ruby.scene.json", "-o", "map.pdsm", "--samples", "64", "--resolution", "96",
                   "--report", "report.json", "--quiet"})
                  .exit_code,
              0);
  }

  /// The three numbers of an answer to one point.
  [[nodiscard]] std::vector<double> rgb(const std::vector<std::string>& arguments,
                                        const std::string& point) const {
    RunSetup setup;
    setup.input = point + "\n";
    const Outcome outcome = run(arguments, setup);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream line(outcome.out);
    std::vector<double> values;
    for (double value = 0; line >> value;) values.push_back(value);
    return values;
  }
};

TEST_F(ChannelsCommand, FromBakeToError) {
  bake();
  bool named = false;
  const auto report = nlohmann::json::parse(contents("report.json"));
  for (const auto& feature : report["modelled"])
    named = named || (feature["feature"] == "colour" && feature["modelled"] == true);
  EXPECT_TRUE(named);
  // Below the middle of both panes all of the light comes through both.
  const std::vector<double> expected{1 - 0.5 * 0.9, 1 - 0.5 * 0.25, 1};
  const std::vector<double> baked = rgb({"query", "map.pdsm"}, "0 0.01 0"),
                            traced = rgb({"truth", "ruby.scene.json", "--samples", "256"}, "0 0.01 0");
  ASSERT_EQ(baked.size(), 3U);
  ASSERT_EQ(traced.size(), 3U);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(baked[channel], expected[channel], 0.02) << channel;
    EXPECT_NEAR(traced[channel], expected[channel], 1e-8) << channel;
  }
  // As of opaque ones (cutouts_command_test.cpp).
  const Outcome verified = run({"verify", "map.pdsm", "ruby.scene.json", "--points", "400", "--samples",
                                "256", "--max-error", "0.09", "--json", "--heat-map", "errors.png"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_FALSE(nlohmann::json::parse(verified.out).contains("budget"));
  EXPECT_TRUE(exists("errors.png"));
}

TEST_F(ChannelsCommand, NothingIsBakedAgainAndChangesAreTold) {
  bake();
  const Outcome again =
      run({"bake", "ruby.scene.json", "-o", "map.pdsm", "--samples", "64", "--resolution", "96"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE((again.out + again.err).find("unchanged"), std::string::npos) << again.out << again.err;
  auto scene = nlohmann::json::parse(contents("ruby.scene.json"));
  scene["geometry"][1]["transmission"] = {0.9, 0.25, 0.1};
  write_file("ruby.scene.json", scene.dump());
  const Outcome verified =
      run({"verify", "map.pdsm", "ruby.scene.json", "--points", "50", "--samples", "64"});
  EXPECT_NE(verified.err.find("changed"), std::string::npos) << verified.err;
}

TEST_F(ChannelsCommand, GoalsAndSweepsAreRefused) {
  const Outcome goal = run({"bake", "ruby.scene.json", "-o", "map.pdsm", "--target-error", "0.05"});
  expect_exit(goal, 2);
  EXPECT_NE(goal.err.find("--target-error: goals are not for coloured shadows"), std::string::npos)
      << goal.err;
  const Outcome sweep = run({"tradeoff", "ruby.scene.json", "-o", "sweep"});
  expect_exit(sweep, 2);
  EXPECT_NE(sweep.err.find("coloured shadows can't be swept"), std::string::npos) << sweep.err;
  EXPECT_FALSE(exists("map.pdsm"));
}

}  // namespace
}  // namespace pdsm
