// SPDX-License-Identifier: Apache-2.0
#include <sstream>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class RenderCommand : public ScratchScene {
 protected:
  RenderCommand() { bake_small("map.pdsm"); }

  [[nodiscard]] Outcome render(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--size", "48x36", "--truth-samples", "16"});
    return run(arguments);
  }
};

TEST_F(RenderCommand, WritesPictures) {
  EXPECT_EQ(render({"map.pdsm", "one.scene.json", "-o", "a.png"}).exit_code, 0);
  EXPECT_EQ(contents("a.png").substr(1, 3), "PNG");
  EXPECT_EQ(contents("a.png").substr(16, 8), std::string("\0\0\0\x30\0\0\0\x24", 8));  // 48 x 36
  EXPECT_EQ(render({"map.pdsm", "one.scene.json", "-o", "a.exr"}).exit_code, 0);
  EXPECT_EQ(contents("a.exr").substr(0, 4), "\x76\x2f\x31\x01");
  EXPECT_EQ(render({"one.scene.json", "--truth", "-o", "truth.png"}).exit_code, 0);
  EXPECT_FALSE(contents("truth.png") == contents("a.png"));
}

TEST_F(RenderCommand, RepeatsItself) {
  ASSERT_EQ(render({"map.pdsm", "one.scene.json", "-o", "a.png"}).exit_code, 0);
  ASSERT_EQ(render({"map.pdsm", "one.scene.json", "-o", "b.png"}).exit_code, 0);
  EXPECT_TRUE(contents("a.png") == contents("b.png"));
  ASSERT_EQ(render({"map.pdsm", "one.scene.json", "-o", "c.png", "--camera", "3,2,4,0,0,0,40"}).exit_code, 0);
  EXPECT_FALSE(contents("a.png") == contents("c.png"));
}

TEST_F(RenderCommand, DifferenceTellsNumbers) {
  for (const std::string output : {"d.png", "d.exr"}) {
    const Outcome outcome = render({"map.pdsm", "one.scene.json", "-o", output, "--difference"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(exists(output));
    std::istringstream text(outcome.out);
    std::string pixels, mean, rms, max;
    double count = 0, m = -1, r = -1, x = -1;
    text >> pixels >> count >> mean >> m >> rms >> r >> max >> x;
    EXPECT_EQ(pixels + mean + rms + max, "pixelsmeanrmsmax") << outcome.out;
    EXPECT_GT(count, 0);
    EXPECT_LE(count, 48 * 36);
    EXPECT_GT(m, 0);
    EXPECT_LE(m, r);
    EXPECT_LE(r, x);
    EXPECT_LE(x, 1);
  }
}

TEST_F(RenderCommand, TakesSeveralMaps) {
  ASSERT_EQ(run({"bake", "two.scene.json", "-o", "maps", "--samples", "16", "--resolution", "32"}).exit_code,
            0);
  EXPECT_EQ(render({"maps/key.pdsm", "maps/lamp.pdsm", "two.scene.json", "-o", "both.png"}).exit_code, 0);
  // By their lights' names, not by their order.
  EXPECT_EQ(render({"maps/lamp.pdsm", "maps/key.pdsm", "two.scene.json", "-o", "swapped.exr"}).exit_code, 0);
  const Outcome one = render({"maps/lamp.pdsm", "two.scene.json", "-o", "one.png"});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_EQ(one.err.rfind("warning: ", 0), 0U) << one.err;
  EXPECT_FALSE(contents("one.png") == contents("both.png"));
}

TEST_F(RenderCommand, ALightHasOneMap) {
  bake_small("again.pdsm");
  bake_small("map.pdsm");
  expect_exit(run({"render", "map.pdsm", "again.pdsm", "one.scene.json", "-o", "x.png", "--size", "16x16"}),
              2);
  EXPECT_FALSE(exists("x.png"));
}

TEST_F(RenderCommand, Refuses) {
  expect_exit(render({"map.pdsm", "one.scene.json", "-o", "a.jpg"}), 2);
  expect_exit(render({"map.pdsm", "one.scene.json"}), 2);
  expect_exit(render({"one.scene.json", "-o", "a.png"}), 2);
  expect_exit(render({"map.pdsm", "one.scene.json", "-o", "a.png", "--truth", "--difference"}), 2);
  std::filesystem::create_hard_link(path("map.pdsm"), path("map.png"));
  expect_exit(render({"map.pdsm", "one.scene.json", "-o", "map.png"}), 2);
  expect_exit(render({"plate.obj", "one.scene.json", "-o", "a.png"}), 3);
  expect_exit(render({"map.pdsm", "plate.obj", "-o", "a.png"}), 3);
  expect_exit(render({"map.pdsm", "one.scene.json", "-o", "missing/a.png"}), 4);
  expect_exit(render({"map.pdsm", "one.scene.json", "-o", "missing/a.exr"}), 4);
  EXPECT_FALSE(exists("a.png"));
}

}  // namespace
}  // namespace pdsm
