// SPDX-License-Identifier: Apache-2.0
// A thick hair over a floor, through all commands that look at it.
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class CurvesCommand : public ScratchScene {
 protected:
  CurvesCommand() {
    // One strand along x, 1 m above the floor, 0.4 m thick.
    std::string hair(128, '\0');
    const std::array<std::uint32_t, 4> counts{1, 2, 2 | 4, 1};
    std::memcpy(hair.data(), "HAIR", 4);
    std::memcpy(hair.data() + 4, counts.data(), sizeof counts);
    const std::array<float, 8> values{-3, 1, 0, 3, 1, 0, 0.4F, 0.4F};
    hair.append(reinterpret_cast<const char*>(values.data()), sizeof values);
    write_file("wire.hair", hair);
    auto scene = nlohmann::json::parse(contents("one.scene.json"));
    scene["geometry"] = {{{"file", "floor.obj"}}};
    scene["curves"] = {{{"file", "wire.hair"}}};
    write_file("wire.scene.json", scene.dump());
  }
};

TEST_F(CurvesCommand, FromBakeToPicture) {
  ASSERT_EQ(run({"bake", "wire.scene.json", "-o", "map.pdsm", "--samples", "64", "--resolution", "96",
                 "--report", "report.json", "--quiet"})
                .exit_code,
            0);
  const auto report = nlohmann::json::parse(contents("report.json"));
  bool named = false;
  for (const auto& feature : report["modelled"]) named = named || feature["feature"] == "curves";
  EXPECT_TRUE(named);
  // Just below the wire nothing of the light is seen.
  EXPECT_EQ(value({"query", "map.pdsm"}, "0 0.7 0"), 1);
  EXPECT_EQ(value({"truth", "wire.scene.json", "--samples", "256"}, "0 0.7 0"), 1);
  // As of other casters (cutouts_command_test.cpp); the budget bakes again.
  const Outcome verified = run({"verify", "map.pdsm", "wire.scene.json", "--points", "400", "--samples",
                                "256", "--max-error", "0.09", "--json"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_TRUE(nlohmann::json::parse(verified.out).contains("budget"));
  // The strand itself is in pictures, whether it casts or not.
  auto scene = nlohmann::json::parse(contents("wire.scene.json"));
  scene["curves"][0]["casts"] = false;
  write_file("shown.scene.json", scene.dump());
  scene.erase("curves");
  write_file("bare.scene.json", scene.dump());
  const std::string camera = "0,4,6,0,1,0,40";
  for (const std::string name : {"shown", "bare"})
    ASSERT_EQ(run({"render", name + ".scene.json", "-o", name + ".png", "--truth", "--truth-samples", "4",
                   "--size", "64x48", "--camera", camera})
                  .exit_code,
              0);
  EXPECT_NE(contents("shown.png"), contents("bare.png"));
}

}  // namespace
}  // namespace pdsm
