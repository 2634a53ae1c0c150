// SPDX-License-Identifier: Apache-2.0
// What pictures show unless they are told: rooms from inside, all else from outside.
#include "evaluate/framing.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "plates.h"

namespace pdsm {
namespace {

constexpr float kHalf = 2;  // of the room's edges, metres

/// A room about the origin, its walls one sheet, with a lid or without, and a ball on its floor.
Scene room(bool lid) {
  std::vector<glm::vec3> corners;
  for (const float x : {-kHalf, kHalf})
    for (const float y : {-kHalf, kHalf})
      for (const float z : {-kHalf, kHalf}) corners.emplace_back(x, y, z);
  std::vector<glm::uvec3> walls{{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 4, 5},
                                {0, 5, 1}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  if (lid) walls.insert(walls.end(), {{2, 3, 7}, {2, 7, 6}});
  Scene scene;
  scene.geometry = {geometry_of(corners, walls), sphere({0.8, -1.5, 0.5}, 0.4, 8)};
  return scene;
}

Light light_at(const glm::dvec3& position, LightShape shape) {
  Light light = light_at_origin(std::move(shape));
  light.position = position;
  light.direction = {0, -1, 0};
  light.up = {0, 0, 1};
  return light;
}

Framing framing_of(const Scene& scene, const std::vector<Light>& lights) {
  return find_framing(scene, PictureScene(scene), lights);
}

bool inside(const glm::dvec3& p) {
  return glm::all(glm::lessThan(glm::abs(p), glm::dvec3(kHalf)));
}

/// The eye sees the middle, which is no farther from the room's than what is cut off at either end.
void expect_seen_from_inside(const Scene& scene, const std::vector<Light>& lights) {
  const auto [focus, camera] = framing_of(scene, lights);
  EXPECT_TRUE(inside(camera.eye));
  EXPECT_TRUE(inside(focus.centre));
  EXPECT_GT(focus.radius, kHalf);
  EXPECT_LT(focus.radius, std::sqrt(3.0) * kHalf);
  EXPECT_EQ(camera.target, focus.centre);
  EXPECT_GT(glm::distance(camera.eye, camera.target), 0.5 * kHalf);
}

TEST(Framing, ClosedRoomsAreSeenFromInside) {
  expect_seen_from_inside(room(true), {light_at({0, 0.5, 0}, SphereLight{0.1})});
  expect_seen_from_inside(room(true), {light_at({0.5, kHalf, 0}, RectLight{1, 1})});
}

TEST(Framing, EyesOfPeopleAreNeitherOnTheFloorNorUnderTheCeiling) {
  const Camera camera = framing_of(room(true), {light_at({0, 0.5, 0}, SphereLight{0.1})}).camera;
  EXPECT_LT(std::abs(camera.eye.y), 0.6 * kHalf);
}

TEST(Framing, RoomsWithoutALidAreSeenFromOutside) {
  const Framing framing = framing_of(room(false), {light_at({0, 0.5, 0}, SphereLight{0.1})});
  EXPECT_FALSE(inside(framing.camera.eye));
  EXPECT_GT(framing.camera.eye.y, framing.camera.target.y);
}

TEST(Framing, LampsThatCanBeSeenAreSeenFromOutside) {
  Scene scene = room(true);
  scene.geometry.push_back(quad({-9, -2, -9}, {9, -2, -9}, {9, -2, 9}, {-9, -2, 9}));
  const Light bulb = light_at({0, 0.5, 0}, SphereLight{0.1}), street = light_at({6, 1, 0}, DiskLight{0.2});
  EXPECT_TRUE(inside(framing_of(scene, {bulb}).camera.eye));
  EXPECT_FALSE(inside(framing_of(scene, {bulb, street}).camera.eye));
  EXPECT_FALSE(inside(framing_of(scene, {street}).camera.eye));
  EXPECT_FALSE(inside(framing_of(scene, {bulb, light_at({0, 9, 0}, DistantLight{0.5})}).camera.eye));
}

/// A glass around the bulb that casts no shadow is no room.
TEST(Framing, LampshadesThatCastNothingAreNoRooms) {
  Scene scene = room(true);
  scene.geometry.push_back(sphere({0, 0.5, 0}, 0.15, 8));
  scene.geometry.back().casts = false;
  const Light bulb = light_at({0, 0.5, 0}, SphereLight{0.1});
  expect_seen_from_inside(scene, {bulb});
  scene.geometry.back().casts = true;
  EXPECT_LT(framing_of(scene, {bulb}).focus.radius, 0.16 * std::sqrt(3.0));
}

/// The room of a small lamp far from everything else, thin walls about it: by 1000 room lengths.
TEST(Framing, RoomsMayBeSmallPartsOfALevel) {
  Scene scene = room(true);
  scene.geometry.push_back(sphere({4000, 0, 0}, 5, 8));
  expect_seen_from_inside(scene, {light_at({0, 0.5, 0}, SphereLight{0.1})});
}

TEST(Framing, EmptyScenesHaveOneToo) {
  const Framing framing = framing_of(Scene{}, {light_at({0, 0, 0}, SphereLight{0.1})});
  EXPECT_EQ(framing.focus.radius, 1);
  EXPECT_GT(glm::distance(framing.camera.eye, framing.camera.target), 1);
}

}  // namespace
}  // namespace pdsm
