// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>

#include "evaluate/colour.h"
#include "evaluate/render.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/map_file.h"
#include "picture.h"
#include "plate_scene.h"

namespace pdsm {
namespace {

class ModePictures : public PlateScene {
 protected:
  /// What the command line's renderer makes of the same view.
  [[nodiscard]] static Picture rendered(ShadowSource source) {
    const Scene scene = read_scene(path("plate.scene.json"));
    const PenumbraMap map = read_map(path("key.pdsm"));
    const PictureLight light{&scene.lights[0], &map, map.views[0].near_depth};
    RenderOptions options;
    options.camera = camera();
    options.width = kWidth;
    options.height = kHeight;
    options.supersample = source == ShadowSource::map ? 4 : 1;
    options.source = source;
    return render(scene, {&light, 1}, options);
  }
  /// Whether the pixel and those around it show nothing but the floor.
  [[nodiscard]] static bool shows_floor(std::uint32_t x, std::uint32_t y) {
    for (const double dx : {-2.0, 0.5, 3.0}) {
      for (const double dy : {-2.0, 0.5, 3.0}) {
        if (!floor_at(x + dx, y + dy)) return false;
      }
    }
    return true;
  }
};

TEST_F(ModePictures, VisibilityIsTheClosedForm) {
  RgbImage image = picture({"--mode", "visibility"});
  int umbra = 0, lit = 0, penumbra = 0;
  double sum = 0, worst = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (!shows_floor(x, y)) continue;
      const double expected = 1 - hidden_from(*floor_at(x + 0.5, y + 0.5));
      const double error = std::abs(static_cast<double>(image.at(x, y).g) - expected);
      (expected == 0 ? umbra : expected == 1 ? lit : penumbra) += 1;
      sum += error;
      worst = std::max(worst, error);
    }
  }
  EXPECT_GT(umbra, 300);
  EXPECT_GT(lit, 20000);
  EXPECT_GT(penumbra, 1000);
  EXPECT_LT(sum / (umbra + lit + penumbra), 0.002);
  EXPECT_LT(worst, 0.08);
}

TEST_F(ModePictures, ShadedIsWhatTheCommandLineRenders) {
  const PictureDifference difference = compare(picture({}), rendered(ShadowSource::map).display);
  EXPECT_LT(difference.mean, 0.002);
  EXPECT_LT(difference.max, 0.2);  // at edges, where samples of a pixel differ
}

TEST_F(ModePictures, TruthIsWhatTheCommandLineTraces) {
  const RgbImage image = picture({"--mode", "truth"});
  const PictureDifference truth = compare(image, rendered(ShadowSource::truth).display);
  EXPECT_LT(truth.mean, 0.003);
  // It is not the maps' picture: of other maps it would be the same.
  copy("empty.pdsm", "key.pdsm");
  EXPECT_EQ(compare(picture({"--mode", "truth"}), image).max, 0);
  EXPECT_GT(compare(picture({}), image).mean, 0.005);
}

TEST_F(ModePictures, ErrorIsWhatTheCommandLineMeasures) {
  ViewerOutcome outcome;
  RgbImage image = picture({"--mode", "error"}, &outcome);
  std::istringstream lines(outcome.out);
  std::string word;
  double pixels = 0, mean = 0, rms = 0, max = 0;
  lines >> word >> pixels >> word >> mean >> word >> rms >> word >> max;
  ASSERT_TRUE(lines) << outcome.out;
  const DifferenceSummary expected = summarise_difference(rendered(ShadowSource::difference).difference);
  EXPECT_NEAR(pixels, static_cast<double>(expected.pixels), 20);
  EXPECT_NEAR(mean, expected.mean_abs, 3e-4);
  EXPECT_NEAR(rms, expected.rms, 5e-3);  // a pixel at an edge of the plate may show another side of it
  EXPECT_LT(mean, 0.01);
  EXPECT_GT(max, 0);
  // Lit floor: hardly any error, so the dark end of the scale with its faint shade.
  const glm::uvec2 lit = pixel_of(camera(), image, {3, 0, 0});
  EXPECT_LT(glm::distance(image.at(lit.x, lit.y), heat_colour(0)), 0.35F);
}

TEST_F(ModePictures, ErrorOfAMapWithoutShadowIsLarge) {
  copy("empty.pdsm", "key.pdsm");
  ViewerOutcome outcome;
  RgbImage image = picture({"--mode", "error"}, &outcome);
  EXPECT_NE(outcome.out.find("max 1.000000"), std::string::npos) << outcome.out;
  const glm::uvec2 umbra = pixel_of(camera(), image, {0.9, 0, 1.0});
  EXPECT_LT(glm::distance(image.at(umbra.x, umbra.y), heat_colour(1)), 0.05F);
}

TEST_F(ModePictures, SliceShowsTheUmbraAsABody) {
  const RgbImage plain = picture({});
  RgbImage image = picture({"--mode", "slice"});
  // The plane z = 0 below the plate is in the umbra: nearly the scale's bright end.
  const glm::uvec2 below = pixel_of(camera(), image, {0.5, 0.25, 0});
  EXPECT_LT(glm::distance(image.at(below.x, below.y), heat_colour(1)), 0.15F);
  // Beside it the air is lit, and the floor behind shows through, dimmed.
  RgbImage undimmed = plain;
  const glm::uvec2 beside = pixel_of(camera(), image, {2.2, 0.25, 0});
  EXPECT_LT(image.at(beside.x, beside.y).r, undimmed.at(beside.x, beside.y).r);
  EXPECT_GT(image.at(beside.x, beside.y).g, 0.15F);
  EXPECT_LT(image.at(beside.x, beside.y).g, 0.6F);
}

TEST_F(ModePictures, FunctionIsPlottedWithThePanels) {
  const auto curve_pixels = [](const std::string& mode) {
    // The middle of the picture, which stands in for the cursor, is a point in the umbra.
    const ViewerOutcome outcome =
        run({"plate.scene.json", "key.pdsm", "--show", "none", "--size", "700x400", "--screenshot",
             "shot.png", "--camera", "1.5,3.2,6,1,0,1,45", "--mode", mode});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const RgbImage image = read_png(path("shot.png"));
    const glm::vec3 curve(245 / 255.0F, 168 / 255.0F, 82 / 255.0F);
    int count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const bool beside_the_panel = i % image.width > 320;
      count += beside_the_panel && glm::distance(image.pixels[i], curve) < 0.02F ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(curve_pixels("function"), 80);
  EXPECT_EQ(curve_pixels("shaded"), 0);
}

TEST_F(ModePictures, LayoutsAgreeAndFiltersDiffer) {
  const RgbImage plain = picture({"--mode", "visibility"});
  EXPECT_LE(compare(picture({"--mode", "visibility", "--layout", "fixed-depth"}), plain).max, 1.5 / 255);
  const PictureDifference nearest = compare(picture({"--mode", "visibility", "--filter", "nearest"}), plain);
  EXPECT_GT(nearest.max, 0.005);
  EXPECT_LT(nearest.mean, 0.02);
}

TEST_F(ModePictures, TruthOfALightThatNoMapCanBeBakedOf) {
  // Nothing lies behind its near depth: without a map it shines all the same, and all of it is blocked by
  // nothing that counts.
  write("far.scene.json", R"({ "geometry": [ { "file": "plate.obj" }, { "file": "floor.obj" } ], "lights": [
    { "name": "key", "type": "rect", "position": [0, 4, 0], "direction": [0, -1, 0], "width": 1, "height": 1,
      "near": 100 } ] })");
  EXPECT_GT(brightness(picture({"far.scene.json", "--mode", "truth"})), 0.1);
}

}  // namespace
}  // namespace pdsm
