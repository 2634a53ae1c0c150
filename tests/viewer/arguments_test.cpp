// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "picture.h"
#include "plate_scene.h"

namespace pdsm {
namespace {

class ViewerArguments : public PlateScene {
 protected:
  /// Names in the folder, sorted.
  [[nodiscard]] static std::vector<std::string> listing() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST_F(ViewerArguments, HelpAndVersionAreResults) {
  const ViewerOutcome help = run({"--help"}, false);
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("--screenshot"), std::string::npos);
  EXPECT_EQ(help.err, "");
  EXPECT_EQ(run({"--version"}, false).out.substr(0, 12), "pdsm-viewer ");
}

TEST_F(ViewerArguments, FaultsOfUsageAreTwo) {
  const std::vector<std::vector<std::string>> commands{
      {"--mode", "psychedelic", "plate.scene.json"},
      {"--size", "8x8", "plate.scene.json"},
      {"--size", "320", "x", "plate.scene.json"},
      {"--camera", "1,2,3", "plate.scene.json"},
      {"--camera", "0,0,0,0,0,0,40", "plate.scene.json"},
      {"--show", "object,unicorn", "plate.scene.json"},
      {"--frames", "0", "--screenshot", "shot.png", "plate.scene.json"},
      {"--frames", "3", "plate.scene.json"},
      {"--no-ui", "plate.scene.json"},
      {"--screenshot", "shot.png"},
      {"--screenshot", "shot.jpg", "plate.scene.json"},
      {"--screenshot", "plate.obj.png", "plate.scene.json", "two.scene.json"},
      {"--unknown"},
      {"key.pdsm"},
      {"plate.scene.json", "key.pdsm", "baked.pdsm", "--screenshot", "shot.png"}};
  for (const std::vector<std::string>& command : commands) {
    SCOPED_TRACE(command[0] + " " + (command.size() > 1 ? command[1] : ""));
    expect_fault(run(command, false), 2);
  }
  EXPECT_FALSE(std::filesystem::exists(path("shot.png")));
}

TEST_F(ViewerArguments, BadFilesAreThree) {
  write("bad.pdsm", "this is no map");
  expect_fault(run({"plate.scene.json", "bad.pdsm", "--screenshot", "shot.png"}), 3);
  expect_fault(run({"plate.scene.json", "missing.pdsm", "--screenshot", "shot.png"}), 3);
  expect_fault(run({"missing.scene.json", "--screenshot", "shot.png"}), 3);
  // A map of a light that the scene does not have.
  const ViewerOutcome stranger = run({"plate.scene.json", "lamp.pdsm", "--screenshot", "shot.png"});
  expect_fault(stranger, 3);
  EXPECT_NE(stranger.err.find("lamp.pdsm:light: "), std::string::npos) << stranger.err;
  EXPECT_FALSE(std::filesystem::exists(path("shot.png")));
}

TEST_F(ViewerArguments, WithoutADisplayIsFour) {
  const ViewerOutcome outcome = run({"plate.scene.json", "key.pdsm", "--screenshot", "shot.png"}, false);
  expect_fault(outcome, 4);
  EXPECT_EQ(outcome.err.substr(0, 9), "display: ");
}

TEST_F(ViewerArguments, UnwritableScreenshotIsFourAndLeavesNothing) {
  const std::vector<std::string> before = listing();
  expect_fault(run({"plate.scene.json", "key.pdsm", "--screenshot", "nowhere/shot.png"}), 4);
  expect_fault(run({"plate.scene.json", "key.pdsm", "--screenshot", "/dev/full/shot.png"}), 4);
  EXPECT_EQ(listing(), before);
}

TEST_F(ViewerArguments, AnInputIsNeverOverwritten) {
  copy("key.pdsm", "map.png");
  expect_fault(run({"plate.scene.json", "map.png", "--screenshot", "map.png"}), 2);
  EXPECT_EQ(std::filesystem::file_size(path("map.png")), std::filesystem::file_size(path("key.pdsm")));
  std::filesystem::remove(path("map.png"));
}

TEST_F(ViewerArguments, FilesComeInAnyOrderAndAreToldByContent) {
  const RgbImage usual = picture({"two.scene.json", "key.pdsm", "lamp.pdsm"});
  EXPECT_EQ(compare(picture({"key.pdsm", "lamp.pdsm", "two.scene.json"}), usual).max, 0);
  copy("lamp.pdsm", "lamp");
  EXPECT_LE(compare(picture({"lamp", "two.scene.json", "key.pdsm"}), usual).max, 1.5 / 255);
}

TEST_F(ViewerArguments, LightsWithoutAMapStayDark) {
  const RgbImage both = picture({"two.scene.json", "key.pdsm", "lamp.pdsm"});
  const RgbImage one = picture({"two.scene.json", "key.pdsm"});
  // One light alone is as bright as in a scene of its own.
  EXPECT_EQ(compare(one, picture({})).max, 0);
  EXPECT_GT(compare(one, both).mean, 0.01);
}

TEST_F(ViewerArguments, ASceneWithoutMapsIsLitWithoutShadow) {
  copy("empty.pdsm", "key.pdsm");
  EXPECT_LE(compare(picture({"plate.scene.json"}), picture({})).max, 1.5 / 255);
}

}  // namespace
}  // namespace pdsm
