// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "picture.h"
#include "plate_scene.h"

namespace pdsm {
namespace {

class MovingThings : public PlateScene {};

TEST_F(MovingThings, RepeatThemselvesAndMove) {
  const std::vector<std::string> all{"--show", "object,particles,fog,gizmos,frustum"};
  const auto after = [&](const std::string& frames) {
    std::vector<std::string> arguments = all;
    arguments.insert(arguments.end(), {"--frames", frames});
    return picture(arguments);
  };
  const RgbImage first = after("3");
  EXPECT_EQ(compare(first, after("3")).max, 0);
  EXPECT_GT(compare(first, after("12")).max, 0.05);
}

TEST_F(MovingThings, EachShows) {
  const std::string from = "4,4,12,0,1.6,0,45";
  const RgbImage plain = picture({"--camera", from});
  for (const char* thing : {"object", "particles", "fog", "gizmos", "frustum"}) {
    EXPECT_GT(compare(picture({"--show", thing, "--camera", from}), plain).max, 0.05) << thing;
  }
}

TEST_F(MovingThings, FogIsDarkerInTheShadow) {
  // From the side, against the background: the air under the plate and beside it.
  const std::vector<std::string> view{"--show", "fog", "--camera", "0,0.8,7,0,0.8,0,40"};
  const Camera camera{{0, 0.8, 7}, {0, 0.8, 0}, 40};
  RgbImage shadowed = picture(view);
  copy("empty.pdsm", "key.pdsm");
  RgbImage lit = picture(view);
  const glm::uvec2 below = pixel_of(camera, lit, {0, 0.7, 0}), beside = pixel_of(camera, lit, {2.4, 0.7, 0});
  EXPECT_LT(shadowed.at(below.x, below.y).g, lit.at(below.x, below.y).g - 0.01F);
  EXPECT_NEAR(shadowed.at(beside.x, beside.y).g, lit.at(beside.x, beside.y).g, 0.02);
}

TEST_F(MovingThings, ObjectReceivesTheShadow) {
  const auto object_picture = [](const std::string& mode) {
    return picture({"--show", "object", "--frames", "20", "--mode", mode});
  };
  // The object is the one thing with a colour; its path is chosen through the shadow.
  const RgbImage shaded = object_picture("shaded"), visibility = object_picture("visibility");
  float darkest = 1, brightest = 0;
  int pixels = 0;
  for (std::size_t i = 0; i < shaded.pixels.size(); ++i) {
    if (shaded.pixels[i].r < 1.6F * shaded.pixels[i].b) continue;
    ++pixels;
    darkest = std::min(darkest, visibility.pixels[i].g);
    brightest = std::max(brightest, visibility.pixels[i].g);
  }
  EXPECT_GT(pixels, 200);
  EXPECT_LT(darkest, 0.5F);
  EXPECT_GT(brightest, darkest + 0.1F);
}

TEST_F(MovingThings, PanelsAreLeftOutOnDemand) {
  const RgbImage without = picture({});
  const ViewerOutcome outcome =
      run({"plate.scene.json", "key.pdsm", "--show", "none", "--camera", "1.5,3.2,6,0.4,0.2,0,45", "--size",
           "320x240", "--screenshot", "shot.png"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(compare(read_png(path("shot.png")), without).mean, 0.05);
}

}  // namespace
}  // namespace pdsm
