// SPDX-License-Identifier: Apache-2.0
// How bright lights are in pictures.
#include "evaluate/studio.h"

#include <gtest/gtest.h>

namespace pdsm {
namespace {

/// At the origin, shining down.
template <typename Shape>
Light light_of(const Shape& shape) {
  Light light;
  light.shape = shape;
  light.direction = {0, -1, 0};
  light.up = {0, 0, 1};
  return light;
}

/// What a white surface at `position` that is turned to the origin shows of a light of colour 2.
double brightness_at(const StudioLight& studio, const glm::dvec3& position) {
  return static_cast<double>(studio.colour.r *
                             irradiance(studio, position, glm::vec3(-glm::normalize(position))));
}

TEST(Studio, DistantLightsAreEverywhereAsBrightByTheAngleAlone) {
  const StudioLight studio = make_studio_light(light_of(DistantLight{0.53}), {{1, 2, 3}, 5}, glm::vec3(2));
  for (const glm::dvec3& p : {glm::dvec3(0), glm::dvec3(1e4, -1e5, 7)}) {
    EXPECT_NEAR(studio.colour.r * irradiance(studio, p, {0, 1, 0}), 2, 1e-5);
    EXPECT_NEAR(studio.colour.r * irradiance(studio, p, {0.8F, 0.6F, 0}), 1.2, 1e-5);
    EXPECT_EQ(irradiance(studio, p, {0, -1, 0}), 0);
  }
}

/// Colours are floats: off by 2^-22 or so in all.
TEST(Studio, LightsHaveTheirColourAtTheFocus) {
  const glm::dvec3 focus(1, -8, 2);
  EXPECT_NEAR(brightness_at(make_studio_light(light_of(RectLight{1, 2}), {focus, 3}, glm::vec3(2)), focus), 2,
              1e-5);
  EXPECT_NEAR(brightness_at(make_studio_light(light_of(SphereLight{0.1}), {focus, 3}, glm::vec3(2)), focus),
              2, 1e-5);
}

/// In the middle of what it lights, a bulb would take its own surface for what is to be bright.
TEST(Studio, LightsCloseToTheFocusHaveTheirColourAsFarAwayAsWallsAre) {
  for (const double away : {0.0, 0.01, 1.0}) {
    const Focus focus{{0, 0, away}, 5};
    const glm::dvec3 seen =
        kStudioLeastDistance * focus.radius * (away > 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, -1, 0));
    EXPECT_NEAR(brightness_at(make_studio_light(light_of(SphereLight{0.1}), focus, glm::vec3(2)), seen), 2,
                1e-5);
  }
}

TEST(Studio, LightsThatShineElsewhereHaveTheirColourAhead) {
  const Focus focus{{0, 4, 0}, 3};
  const StudioLight studio = make_studio_light(light_of(RectLight{1, 2}), focus, glm::vec3(2));
  EXPECT_NEAR(brightness_at(studio, {0, -6, 0}), 2, 1e-5);
}

}  // namespace
}  // namespace pdsm
