// SPDX-License-Identifier: Apache-2.0
#include <signal.h>

#include <functional>

#include "picture.h"
#include "plate_scene.h"

namespace pdsm {
namespace {

class Reload : public PlateScene {
 protected:
  /// A run during which `change` happens after the maps were read and before anything is drawn: the viewer
  /// stands still meanwhile.
  static ViewerOutcome run_with_change(const std::function<void()>& change) {
    const CloseWatch map_read(path("key.pdsm"));
    ViewerProcess viewer({"plate.scene.json", "key.pdsm", "--mode", "visibility", "--show", "none",
                          "--camera", "1.5,3.2,6,0.4,0.2,0,45", "--size", "320x240", "--no-ui", "--frames",
                          "40", "--screenshot", "shot.png"},
                         folder());
    map_read.wait();
    viewer.send(SIGSTOP);
    change();
    viewer.send(SIGCONT);
    return viewer.finish();
  }
};

TEST_F(Reload, ReplacedMapIsTaken) {
  const RgbImage before = picture({"--mode", "visibility"});
  const ViewerOutcome outcome = run_with_change([] { copy("empty.pdsm", "key.pdsm"); });
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "key.pdsm: read anew\nwarning: key.pdsm: the scene has changed since the bake\n");
  const RgbImage after = read_png(path("shot.png"));
  EXPECT_GT(compare(before, after).max, 0.9);
  // The map without shadow was in place from the start here.
  EXPECT_EQ(compare(after, picture({"--mode", "visibility"})).max, 0);
}

TEST_F(Reload, DamagedMapKeepsTheOldAndSaysSo) {
  const RgbImage before = picture({"--mode", "visibility"});
  const ViewerOutcome outcome = run_with_change([] {
    write("damaged", "this is no map");
    std::filesystem::rename(path("damaged"), path("key.pdsm"));
  });
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.substr(0, 9), "key.pdsm:");
  EXPECT_TRUE(outcome.err.ends_with("; the old map stays\n")) << outcome.err;
  EXPECT_EQ(compare(read_png(path("shot.png")), before).max, 0);
}

TEST_F(Reload, MapThatIsGoneForAWhileIsKept) {
  const RgbImage before = picture({"--mode", "visibility"});
  const ViewerOutcome outcome = run_with_change([] { std::filesystem::remove(path("key.pdsm")); });
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(compare(read_png(path("shot.png")), before).max, 0);
}

}  // namespace
}  // namespace pdsm
