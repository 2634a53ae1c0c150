// SPDX-License-Identifier: Apache-2.0
#include "evaluate/window_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "evaluate/last_receivers.h"
#include "plates.h"

namespace pdsm {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// A map of 8 x 6 texels without shadow, of light space.
PenumbraMap empty_map() {
  PenumbraMap map;
  View view;
  view.window = {-0.4, -0.3, 0.4, 0.3};
  view.near_depth = 2;
  view.far_depth = 8;
  view.width = 8;
  view.height = 6;
  map.views = {view};
  FunctionImage image;
  image.width = view.width;
  image.height = view.height;
  image.blocks.resize(1);
  image.blocks[0].first.assign(49, 0);
  map.images = {image};
  return map;
}

/// A plate beside a floor that ends at x = 0, and one over it. Texel (i, j) has the slopes 0.1 i - 0.35 and
/// 0.1 j - 0.25: the first plate shows in texels (5, 2) and (5, 3), the second hides (2, 2) and (2, 3).
Scene plates_and_floor() {
  Scene scene;
  scene.lights = {light_at_origin(RectLight{0.1, 0.1})};
  scene.geometry = {plate(0.35, -0.3, 0.85, 0.3, 4), plate(-40, -40, 0, 40, 8),
                    plate(-0.85, -0.3, -0.35, 0.3, 4)};
  return scene;
}

TEST(LastReceivers, AreTheFarthestThatFaceTheLight) {
  Scene scene = plates_and_floor();
  const View view = empty_map().views[0];
  const auto depth = [&](std::uint32_t i, std::uint32_t j) {
    const auto point = LastReceivers(scene, view).find({i, j});
    return point ? point->z : -1.0;
  };
  EXPECT_NEAR(depth(0, 0), 8, 1e-6);  // slope -0.35: the floor
  EXPECT_NEAR(depth(5, 3), 4, 1e-6);  // slopes 0.15, 0.05: the plate
  EXPECT_EQ(depth(7, 0), -1);         // slopes 0.35, -0.25: past both
  // A point lies on its ray.
  const auto point = LastReceivers(scene, view).find({5, 3});
  EXPECT_NEAR(point->x / point->z, 0.15, 1e-7);
  EXPECT_NEAR(point->y / point->z, 0.05, 1e-7);
  scene.geometry[0].receives = false;
  EXPECT_EQ(depth(5, 3), -1);
  // What lies behind far does not receive.
  scene.geometry.resize(2);
  scene.geometry[1] = plate(-40, -40, 40, 40, 8.1);
  EXPECT_EQ(depth(0, 0), -1);

  // A closed sphere shows its near side, mirrored or not, and an open one its far side.
  scene.geometry = {sphere({0, 0, 5}, 2.5, 24)};
  ASSERT_TRUE(scene.geometry[0].mesh->closed);
  EXPECT_LT(depth(4, 3), 3.5);
  scene.geometry[0] = mirrored(scene.geometry[0]);
  EXPECT_LT(depth(4, 3), 3.5);
  auto open = std::make_shared<Mesh>(*scene.geometry[0].mesh);
  open->closed = false;
  scene.geometry[0].mesh = open;
  EXPECT_GT(depth(4, 3), 6.5);
}

TEST(WindowErrors, AreLookUpMinusTruthAtTheLastReceiver) {
  const Scene scene = plates_and_floor();
  const PenumbraMap map = empty_map();
  const auto texels = all_texels(map.views[0]);
  ASSERT_EQ(texels.size(), 48U);
  const std::vector<TexelError> errors = measure_texels(map, scene, scene.lights[0], texels, 64, 1);
  // Umbra, light, nothing there: '#', '.', ' ', row by row from y0.
  const std::string expected = "....    ....    ..#. .  ..#. .  ....    ....    ";
  std::string found;
  for (const TexelError& texel : errors)
    found += std::isnan(texel.error)                 ? ' '
             : texel.error == -1 && texel.truth == 1 ? '#'
             : texel.error == 0                      ? '.'
                                                     : '?';
  EXPECT_EQ(found, expected);
  // A texel's error does not depend on which others are measured.
  const std::vector<std::array<std::uint32_t, 2>> one{{2, 3}};
  EXPECT_EQ(measure_texels(map, scene, scene.lights[0], one, 64, 1)[0].error, -1);
}

TEST(WindowErrors, DrawnTexelsFillTheWindow) {
  const View view = empty_map().views[0];
  std::vector<int> hits(48);
  for (const auto& [i, j] : draw_texels(view, 4800, 5)) ++hits.at(j * 8 + i);
  // Binomial, 100 expected: five standard deviations.
  for (const int count : hits) EXPECT_NEAR(count, 100, 50);
}

TEST(WindowErrors, AttyErrorDividesByWhatIsInShadow) {
  // False shadow on a lit texel counts, and does not dilute; what meets no receiver is left out.
  const std::vector<TexelError> errors{
      {-0.5F, 1.0F}, {0.25F, 0.0F}, {0.0F, 0.0F}, {kNothing, kNothing}, {0.25F, 0.5F}};
  EXPECT_DOUBLE_EQ(atty_error(errors), 1.0 / 2);
  EXPECT_EQ(atty_error(std::vector<TexelError>{}), 0);
}

TEST(WindowErrors, PicturesStandUpright) {
  // 2 x 3 texels; the last row of the map is the first of the picture.
  const std::vector<TexelError> errors{{0.1F, 1}, {0.2F, 1},  {0.3F, 1},
                                       {0.4F, 1}, {-0.5F, 1}, {kNothing, kNothing}};
  const FloatPlane plane = window_error_plane(2, 3, errors);
  EXPECT_EQ(plane.name, "Y");
  ASSERT_EQ(plane.values.size(), 6U);
  EXPECT_EQ(plane.values[0], -0.5F);
  EXPECT_TRUE(std::isnan(plane.values[1]));
  EXPECT_EQ(plane.values[2], 0.3F);
  EXPECT_EQ(plane.values[4], 0.1F);
  RgbImage image = draw_window_errors(2, 3, errors);
  EXPECT_EQ(image.width, 2U);
  EXPECT_GT(image.height, 3U);  // the scale
  // Greater errors are lighter, whatever their sign.
  const auto lightness = [](const glm::vec3& c) { return c.x + c.y + c.z; };
  EXPECT_GT(lightness(image.at(0, 0)), lightness(image.at(0, 1)));
  EXPECT_GT(lightness(image.at(0, 1)), lightness(image.at(0, 2)));
}

}  // namespace
}  // namespace pdsm
