// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "pdsm/bake/scene.h"
#include "pdsm/format/error.h"
#include "test_meshes.h"

namespace pdsm {
namespace {

glm::dvec3 row(const RigidTransform& transform, std::size_t i) {
  const auto& r = transform.rotation;
  return {r[3 * i], r[3 * i + 1], r[3 * i + 2]};
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

Light light_towards(const glm::dvec3& direction) {
  Light light;
  light.name = "key";
  light.direction = direction;
  return light;
}

std::string fault_of(const Light& light) {
  try {
    (void)light_frame(light);
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::input);
    return error.what();
  }
  return "";
}

TEST(LightFrame, LampAboveHasExactAxes) {
  const RigidTransform frame = light_frame(test::lamp_above({1, 12, -2}, 3, 3));
  EXPECT_EQ(row(frame, 0), glm::dvec3(1, 0, 0));
  EXPECT_EQ(row(frame, 1), glm::dvec3(0, 0, 1));
  EXPECT_EQ(row(frame, 2), glm::dvec3(0, -1, 0));
  EXPECT_EQ(apply(frame, {1, 12, -2}), glm::dvec3(0));
  EXPECT_EQ(apply(frame, {1.5, 10, -1}), glm::dvec3(0.5, 1, 2));
}

TEST(LightFrame, SidewaysLightHasXByCrossOfUpAndDirection) {
  // cross((0,1,0), (0,0,1)) = (1,0,0); cross((0,1,0), (1,0,0)) = (0,0,-1).
  EXPECT_EQ(row(light_frame(light_towards({0, 0, 2})), 0), glm::dvec3(1, 0, 0));
  EXPECT_EQ(row(light_frame(light_towards({3, 0, 0})), 0), glm::dvec3(0, 0, -1));
  EXPECT_EQ(row(light_frame(light_towards({3, 0, 0})), 1), glm::dvec3(0, 1, 0));
}

TEST(LightFrame, DefaultUpChangesAtOneDegree) {
  const auto x_axis = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return row(light_frame(light_towards({std::sin(angle), -std::cos(angle), 0})), 0);
  };
  // With up = +z the x axis stays near +x; with up = +y it is exactly -z.
  EXPECT_NEAR(x_axis(0.99).x, 1, 1e-3);
  EXPECT_LT(largest(x_axis(1.01) - glm::dvec3(0, 0, -1)), 1e-15);
}

TEST(LightFrame, RefusesDirectionsAndUpsWithoutAngle) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(light_towards({0, 0, 0})), "key.direction: must be finite and not zero");
  EXPECT_EQ(fault_of(light_towards({nan, 0, 1})), "key.direction: must be finite and not zero");
  Light light = light_towards({0, -1, 0});
  for (const glm::dvec3& up :
       {glm::dvec3(0, 5, 0), glm::dvec3(0, -1, 1e-8), glm::dvec3(0), glm::dvec3(nan)}) {
    light.up = up;
    EXPECT_EQ(fault_of(light), "key.up: must be finite, not zero and not parallel to direction");
  }
  light.up = glm::dvec3(0, -1, 1e-4);
  EXPECT_EQ(fault_of(light), "");
}

TEST(LightFrame, LengthsDoNotMatter) {
  Light reference = light_towards({1, -2, 3});
  reference.up = glm::dvec3(0, 1, 1);
  for (const double length : {1e-300, 1e-20, 1e300}) {
    Light light = light_towards(reference.direction * length);
    light.up = *reference.up * length;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(largest(row(light_frame(light), i) - row(light_frame(reference), i)), 1e-15) << length;
    }
  }
}

glm::dvec3 arbitrary_vector(int range) {
  const auto number = [&] { return *rc::gen::inRange(-range, range + 1) / 64.0; };
  return {number(), number(), number()};
}

RC_GTEST_PROP(LightFrame, IsARigidMotionAboutTheLight, ()) {
  Light light = light_towards(arbitrary_vector(1000));
  light.position = arbitrary_vector(100000);
  light.up = arbitrary_vector(1000);
  const double lengths = glm::length(light.direction) * glm::length(*light.up);
  RC_PRE(glm::length(glm::cross(light.direction, *light.up)) > 1e-5 * lengths && lengths > 0);
  const RigidTransform frame = light_frame(light);
  const glm::dvec3 x = row(frame, 0), y = row(frame, 1), z = row(frame, 2);
  RC_ASSERT(largest(glm::cross(x, y) - z) < 1e-15);
  RC_ASSERT(std::abs(glm::dot(x, y)) < 1e-15 && std::abs(glm::length(x) - 1) < 1e-15);
  RC_ASSERT(largest(z - glm::normalize(light.direction)) < 1e-14);
  RC_ASSERT(std::abs(glm::dot(x, glm::normalize(*light.up))) < 1e-10);
  RC_ASSERT(glm::dot(y, *light.up) > 0);
  RC_ASSERT(largest(apply(frame, light.position)) < 1e-11);
  const glm::dvec3 p = arbitrary_vector(100000);
  RC_ASSERT(largest(apply(inverse(frame), apply(frame, p)) - p) < 1e-10);
  RC_ASSERT(largest(apply(frame, apply(inverse(frame), p)) - p) < 1e-10);
}

TEST(HalfExtents, AreHalfTheRectangleAndTheDisksRadius) {
  Light light;
  light.shape = RectLight{3, 1};
  EXPECT_EQ(half_extents(light), (std::array<double, 2>{1.5, 0.5}));
  light.shape = DiskLight{0.7};
  EXPECT_EQ(half_extents(light), (std::array<double, 2>{0.7, 0.7}));
}

}  // namespace
}  // namespace pdsm
