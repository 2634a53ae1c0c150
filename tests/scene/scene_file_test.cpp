// SPDX-License-Identifier: Apache-2.0
// What a good scene file reads as.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

class SceneFile : public testing::Test {
 protected:
  SceneFile() { folder_.write("box.obj", to_obj(box_mesh({1, 2, 3}))); }

  Light light(const std::string& fields) const { return folder_.read(scene_with_light(fields)).lights.at(0); }

  SceneFolder folder_;
};

TEST_F(SceneFile, EmptySceneIsValid) {
  const Scene scene = folder_.read("{}");
  EXPECT_TRUE(scene.geometry.empty());
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(scene.source, (folder_.path() / "level.scene.json").string());
  EXPECT_EQ(folder_.fault_of(R"({"geometry": [], "volumes": [], "lights": []})"), "");
}

TEST_F(SceneFile, GeometryHasItsDefaults) {
  const Scene scene = folder_.read(scene_of("box.obj"));
  ASSERT_EQ(scene.geometry.size(), 1U);
  const Geometry& box = scene.geometry[0];
  EXPECT_EQ(box.name, "box.obj");
  EXPECT_TRUE(box.casts);
  EXPECT_TRUE(box.receives);
  EXPECT_EQ(box.local_to_world, glm::dmat4(1.0));
  EXPECT_TRUE(box.mesh->closed);
  EXPECT_EQ(box.mesh->triangles.size(), 12U);
  EXPECT_DOUBLE_EQ(signed_volume(box), 6);
}

TEST_F(SceneFile, GeometryTakesItsFields) {
  const Scene scene = folder_.read(
      scene_of("box.obj", R"("casts": false, "receives": true, "opacity": 1.0, "translate": [1, 2, 3])"));
  EXPECT_FALSE(scene.geometry[0].casts);
  EXPECT_TRUE(scene.geometry[0].receives);
  EXPECT_EQ(glm::dvec3(scene.geometry[0].local_to_world[3]), glm::dvec3(1, 2, 3));
  EXPECT_FALSE(folder_.read(scene_of("box.obj", R"("receives": false)")).geometry[0].receives);
  EXPECT_EQ(scene.geometry[0].opacity, 1);
  EXPECT_EQ(folder_.read(scene_of("box.obj", R"("opacity": 0.25)")).geometry[0].opacity, 0.25);
}

TEST_F(SceneFile, FilesAreRelativeToTheScene) {
  std::filesystem::create_directory(folder_.path() / "parts and pieces");
  folder_.write("parts and pieces/büchse.obj", to_obj(box_mesh({1, 1, 1})));
  EXPECT_EQ(folder_.read(scene_of("parts and pieces/büchse.obj")).geometry.size(), 1U);
  EXPECT_EQ(folder_.read(scene_of((folder_.path() / "box.obj").string())).geometry.size(), 1U);
}

TEST_F(SceneFile, OneFileTwiceSharesItsMesh) {
  const Scene scene = folder_.read(
      R"({"geometry": [{"file": "box.obj"}, {"file": "box.obj", "translate": [5, 0, 0], "casts": false}]})");
  ASSERT_EQ(scene.geometry.size(), 2U);
  EXPECT_EQ(scene.geometry[0].mesh, scene.geometry[1].mesh);
  EXPECT_TRUE(scene.geometry[0].casts);
  EXPECT_FALSE(scene.geometry[1].casts);
}

TEST_F(SceneFile, CommentsBomAndAnyLineEndsAreAccepted) {
  const std::string text =
      "\xEF\xBB\xBF{ // geometry\r\n \"geometry\": [ /* one */ {\"file\": \"box.obj\"}\r ]\r\n}\r\n";
  EXPECT_EQ(folder_.read(text).geometry.size(), 1U);
}

TEST_F(SceneFile, RectLightTakesAllFields) {
  const Light key =
      light(R"("name": "Key_1-a", "type": "rect", "width": 3, "height": 0, "position": [1, 2, 3],
      "direction": [0, -2, 0], "up": [1, 0, 0], "window": [-1, -0.5, 0.25, 2], "near": 0.5, "far": 20,
      "faces": 1, "resolution": [640, 480], "samples": 65536)");
  EXPECT_EQ(key.name, "Key_1-a");
  EXPECT_EQ(std::get<RectLight>(key.shape).width, 3);
  EXPECT_EQ(std::get<RectLight>(key.shape).height, 0);
  EXPECT_EQ(key.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(key.direction, glm::dvec3(0, -2, 0));
  EXPECT_EQ(key.up, glm::dvec3(1, 0, 0));
  EXPECT_EQ(key.window, (std::array<double, 4>{-1, -0.5, 0.25, 2}));
  EXPECT_EQ(key.near_depth, 0.5);
  EXPECT_EQ(key.far_depth, 20);
  EXPECT_EQ(key.resolution, (std::array<std::uint32_t, 2>{640, 480}));
  EXPECT_EQ(key.samples, 65536U);
}

TEST_F(SceneFile, DiskLightLeavesTheRestOpen) {
  const Light lamp = light(R"("radius": 0)");
  EXPECT_EQ(lamp.name, "light1");
  EXPECT_EQ(std::get<DiskLight>(lamp.shape).radius, 0);
  EXPECT_FALSE(lamp.up || lamp.window || lamp.near_depth || lamp.far_depth || lamp.resolution ||
               lamp.samples);
}

TEST_F(SceneFile, DistantLightTakesAllFields) {
  const Scene scene =
      folder_.read(R"({"geometry": [{"file": "box.obj", "translate": [1e6, 0, -2e6]}], "lights": [
      {"type": "distant", "direction": [0, -3, 0], "up": [1, 0, 0], "angle": 12, "window": [-9, -8, 7, 6],
       "near": 0.5, "far": 20, "resolution": 64, "samples": 9, "name": "sun"},
      {"type": "distant", "direction": [0, -3, 0]}]})");
  const Light& sun = scene.lights[0];
  EXPECT_EQ(std::get<DistantLight>(sun.shape).angle, 12);
  EXPECT_EQ(sun.up, glm::dvec3(1, 0, 0));
  EXPECT_EQ(sun.window, (std::array<double, 4>{-9, -8, 7, 6}));
  EXPECT_EQ(sun.near_depth, 0.5);
  EXPECT_EQ(sun.far_depth, 20);
  EXPECT_EQ(sun.samples, 9U);
  EXPECT_EQ(std::get<DistantLight>(scene.lights[1].shape).angle, 0.53);
}

/// Light space begins above the middle of the geometry, a sixteenth of its diagonal in front of it.
TEST_F(SceneFile, DistantLightsArePlacedInFrontOfTheGeometry) {
  const Scene scene =
      folder_.read(R"({"geometry": [{"file": "box.obj", "translate": [1e6, 0, -2e6]}], "lights": [
      {"type": "distant", "direction": [0, -3, 0]}]})");
  glm::dvec3 low(1e9), high(-1e9);
  const Geometry& box = scene.geometry[0];
  for (const glm::vec3& local : box.mesh->positions) {
    const glm::dvec3 p(box.local_to_world * glm::dvec4(glm::dvec3(local), 1));
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3& at = scene.lights[0].position;
  EXPECT_NEAR(at.x, (low.x + high.x) / 2, 1e-9);
  EXPECT_NEAR(at.z, (low.z + high.z) / 2, 1e-9);
  EXPECT_NEAR(at.y, high.y + glm::length(high - low) / 16, 1e-9);
}

TEST_F(SceneFile, FovIsASymmetricWindow) {
  const double t = std::tan(38.58 / 2 * std::numbers::pi / 180);
  const auto window = light(R"("fov": 38.58)").window.value();
  EXPECT_EQ(window, (std::array<double, 4>{-t, -t, t, t}));
  EXPECT_NEAR(light(R"("fov": 120)").window.value()[2], std::sqrt(3.0), 1e-15);
}

TEST_F(SceneFile, WholeNumbersMayBeWrittenAsFractions) {
  EXPECT_EQ(light(R"("resolution": 512.0)").resolution, (std::array<std::uint32_t, 2>{512, 512}));
  EXPECT_EQ(light(R"("samples": 1e3)").samples, 1000U);
}

}  // namespace
}  // namespace pdsm::test
