// SPDX-License-Identifier: Apache-2.0
// A bulb over a translucent plate, and a ceiling light with five views, through all commands.
#include <nlohmann/json.hpp>
#include <tuple>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class SeveralViewsCommand : public ScratchScene {
 protected:
  SeveralViewsCommand() {
    auto scene = nlohmann::json::parse(contents("one.scene.json"));
    scene["geometry"] = {{{"file", "floor.obj"}}, {{"file", "plate.obj"}, {"opacity", 0.4}}};
    scene["lights"] = {
        {{"name", "bulb"}, {"type", "sphere"}, {"position", {0, 3, 0}}, {"radius", 0.1}, {"far", 4}}};
    write_file("bulb.scene.json", scene.dump());
    scene["geometry"][1].erase("opacity");
    scene["lights"] = {{{"name", "ceiling"},
                        {"type", "rect"},
                        {"position", {0, 3, 0}},
                        {"direction", {0, -1, 0}},
                        {"width", 0.4},
                        {"height", 0.3},
                        {"faces", 5},
                        {"far", 4}}};
    write_file("ceiling.scene.json", scene.dump());
    write_file("tube.obj", "v -0.5 0 -0.01\nv 0.5 0 -0.01\nv 0.5 0 0.01\nv -0.5 0 0.01\nf 1 2 3 4\n");
    nlohmann::json neon = scene;
    neon["lights"] = {{{"name", "neon"},
                       {"type", "mesh"},
                       {"file", "tube.obj"},
                       {"scale", 0.5},
                       {"translate", {0, 3, 0}},
                       {"far", 4}}};
    write_file("neon.scene.json", neon.dump());
    scene["lights"][0].erase("faces");
    scene["lights"][0]["two_sided"] = true;
    write_file("panel.scene.json", scene.dump());
  }

  [[nodiscard]] Outcome bake(const std::string& scene, std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"bake", scene,          "-o", "map.pdsm", "--samples",
                                       "64",   "--resolution", "96", "--quiet"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments);
  }
};

TEST_F(SeveralViewsCommand, FromBakeToError) {
  for (const auto& [scene, views, dark] : {std::tuple("bulb.scene.json", 6U, 0.4),
                                           {"ceiling.scene.json", 5U, 1.0},
                                           {"panel.scene.json", 2U, 1.0},
                                           {"neon.scene.json", 6U, 1.0}}) {
    ASSERT_EQ(bake(scene, {"--report", "report.json"}).exit_code, 0);
    const Outcome info = run({"info", "map.pdsm", "--json"});
    EXPECT_EQ(nlohmann::json::parse(info.out)["views"].size(), views);
    EXPECT_EQ(run({"check", "map.pdsm"}).exit_code, 0);
    // Below the middle of the plate, and beside and above the light.
    for (const auto& [point, expected] : {std::pair("0 0.01 0", dark), {"2 2.9 0", 0.0}, {"0 4 0", 0.0}}) {
      EXPECT_NEAR(value({"query", "map.pdsm"}, point), expected, 0.02) << point;
      EXPECT_NEAR(value({"truth", scene, "--samples", "256"}, point), expected, 1e-9) << point;
    }
    const Outcome verified =
        run({"verify", "map.pdsm", scene, "--points", "500", "--samples", "128", "--max-error", "0.1"});
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    EXPECT_TRUE(verified.err.empty()) << verified.err;
    EXPECT_EQ(verified.out.find("light model") != std::string::npos, views == 6U);
    EXPECT_EQ(run({"render", "map.pdsm", scene, "-o", "a.png", "--size", "32x32"}).exit_code, 0);
  }
}

TEST_F(SeveralViewsCommand, WhatIsForOneViewIsRefusedByName) {
  ASSERT_EQ(bake("ceiling.scene.json").exit_code, 0);
  const auto expect_refused = [](const Outcome& outcome, const std::string& reason) {
    expect_exit(outcome, 2);
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
  };
  expect_refused(bake("ceiling.scene.json", {"--size-budget", "1M"}),
                 "--size-budget: goals are not for lights of several");
  expect_refused(run({"verify", "map.pdsm", "ceiling.scene.json", "--heat-map", "a.png"}),
                 "only maps of one view");
  expect_refused(run({"tradeoff", "ceiling.scene.json", "-o", "sweep"}), "lights of several faces");
}

}  // namespace
}  // namespace pdsm
