// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pdsm/format/error.h"
#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

using nlohmann::json;

/// A triangle's corners, as text that glTF may hold: (0,0,0), (1,0,0), (0,1,0).
constexpr const char* kTriangle =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

/// A glTF scene of a triangle and one node with a light, to be varied by the tests.
class GltfSceneTest : public testing::Test {
 protected:
  GltfSceneTest() {
    gltf_ = {{"asset", {{"version", "2.0"}}},
             {"nodes", {{{"mesh", 0}, {"name", "wall"}}, {{"name", "Lamp"}}}},
             {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
             {"buffers", {{{"uri", kTriangle}, {"byteLength", 36}}}},
             {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
             {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}}};
  }

  json& node() { return gltf_["nodes"][1]; }
  /// The light object in the node's extras.
  json& own() { return node()["extras"]["pdsm_light"]; }
  /// Makes the node use an extension's light, and returns that.
  json& extension(const std::string& name) {
    node()["extensions"][name]["light"] = 0;
    return gltf_["extensions"][name]["lights"][0];
  }

  Scene read() {
    folder_.write("level.gltf", gltf_.dump());
    return read_scene(folder_.path() / "level.gltf");
  }
  Light light() {
    Scene scene = read();
    if (scene.lights.size() != 1) throw std::runtime_error("one light is expected");
    return scene.lights[0];
  }
  std::string fault() {
    folder_.write("level.gltf", gltf_.dump());
    return folder_.scene_fault_of("level.gltf");
  }
  /// What is left out, if nothing is read.
  std::string warning() {
    const Scene scene = read();
    EXPECT_TRUE(scene.lights.empty());
    return scene.warnings.size() == 1 ? scene.warnings[0].substr(folder_.path().string().size() + 1) : "";
  }

  SceneFolder folder_;
  json gltf_;
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  // Rotations are of length 1 up to what the file's decimal digits hold.
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-12) << axis;
}

TEST_F(GltfSceneTest, IsALevel) {
  own() = {{"type", "disk"}, {"radius", 0.25}, {"samples", 64}, {"fov", 90}, {"near", 0.5}};
  const Scene scene = read();
  EXPECT_EQ(scene.source, (folder_.path() / "level.gltf").string());
  ASSERT_EQ(scene.geometry.size(), 1U);
  EXPECT_TRUE(scene.geometry[0].casts && scene.geometry[0].receives);
  ASSERT_EQ(scene.files.size(), 1U);
  EXPECT_NE(scene.content_hash, 0U);
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.lights.size(), 1U);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.name, "Lamp");
  EXPECT_EQ(std::get<DiskLight>(light.shape).radius, 0.25);
  EXPECT_EQ(light.samples, 64U);
  EXPECT_EQ(light.near_depth, 0.5);
  EXPECT_NEAR(light.window.value()[2], 1, 1e-15);
}

TEST_F(GltfSceneTest, TheNodePlacesTheLight) {
  own() = {{"type", "rect"}, {"width", 3}, {"height", 2}};
  expect_near(light().direction, {0, 0, -1});
  expect_near(light().up.value(), {0, 1, 0});
  // A quarter turn about x under a quarter turn about y: -z becomes +y, y becomes z, then x.
  const double half = std::sqrt(0.5);
  node() = {{"translation", {1, 2, 3}}, {"rotation", {half, 0, 0, half}}, {"extras", node()["extras"]}};
  gltf_["nodes"].push_back(
      {{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, half, 0, half}}});
  const Light turned = light();
  expect_near(turned.position, {10 + 3, 2, -1});
  expect_near(turned.direction, {0, 1, 0});
  expect_near(turned.up.value(), {1, 0, 0});
  EXPECT_EQ(turned.name, "light1");
}

TEST_F(GltfSceneTest, MetresStayMetres) {
  own() = {{"type", "rect"}, {"width", 3}, {"height", 2}};
  node()["scale"] = {5, 5, 5};
  EXPECT_EQ(std::get<RectLight>(light().shape).width, 3);
  EXPECT_EQ(std::get<RectLight>(light().shape).height, 2);
}

TEST_F(GltfSceneTest, NamesComeFromNodes) {
  own() = {{"type", "distant"}};
  node()["name"] = "Sun.001 \xc3\xbc";
  EXPECT_EQ(light().name, "Sun_001___");
  own()["name"] = "sun";
  EXPECT_EQ(light().name, "sun");
  gltf_["nodes"].push_back({{"name", "sun"}, {"extras", {{"pdsm_light", {{"type", "distant"}}}}}});
  EXPECT_EQ(fault(), "level.gltf:nodes[2]: its light's name, \"sun\", is that of nodes[1] too");
}

TEST_F(GltfSceneTest, DistantLightsAreBeforeTheScene) {
  own() = {{"type", "distant"}, {"angle", 1.5}};
  node()["translation"] = {100, 200, 300};
  const Light sun = light();
  EXPECT_EQ(std::get<DistantLight>(sun.shape).angle, 1.5);
  // In front of the triangle, along +z, and in the middle of it, wherever the node is.
  EXPECT_GT(sun.position.z, 0);
  EXPECT_LT(sun.position.z, 2);
  EXPECT_NEAR(sun.position.x, 0.5, 1e-6);
}

TEST_F(GltfSceneTest, AreaLightsGrowWithTheirNode) {
  json& area = extension("EXT_lights_area");
  area = {{"type", "rect"}, {"size", 0.5}, {"rect", {{"aspect", 3}}}};
  node()["scale"] = {1, -4, 2};
  EXPECT_EQ(std::get<RectLight>(light().shape).width, 6);
  EXPECT_EQ(std::get<RectLight>(light().shape).height, 2);
  area = {{"type", "disk"}};
  EXPECT_EQ(std::get<DiskLight>(light().shape).radius, 2);
  area = {{"type", "sphere"}};
  EXPECT_EQ(fault(), "level.gltf:extensions.EXT_lights_area.lights[0].type: must be rect or disk");
  area = {{"type", "disk"}, {"size", -1}};
  EXPECT_EQ(fault(), "level.gltf:extensions.EXT_lights_area.lights[0].size: must be a number > 0");
}

TEST_F(GltfSceneTest, PunctualLightsHaveTheirSizeInExtras) {
  json& punctual = extension("KHR_lights_punctual");
  punctual = {{"type", "directional"}, {"extras", {{"angle", 2}}}};
  EXPECT_EQ(std::get<DistantLight>(light().shape).angle, 2);
  punctual = {{"type", "spot"}, {"spot", {{"outerConeAngle", std::numbers::pi / 6}}}};
  node()["extras"]["radius"] = 0.1;
  EXPECT_EQ(std::get<DiskLight>(light().shape).radius, 0.1);
  // The cone's window: tan 30 degrees each way.
  EXPECT_NEAR(light().window.value()[3], 1 / std::sqrt(3), 1e-15);
  EXPECT_NEAR(light().window.value()[0], -1 / std::sqrt(3), 1e-15);
  punctual["extras"] = {{"radius", 0.2}};
  EXPECT_EQ(std::get<DiskLight>(light().shape).radius, 0.2);
  // A cone without an angle is one of 45 degrees; one wider than 60 takes all views in front of it.
  punctual["spot"] = json::object();
  EXPECT_NEAR(light().window.value()[3], 1, 1e-15);
  punctual["spot"]["outerConeAngle"] = 1.5;
  EXPECT_FALSE(light().window);
  EXPECT_EQ(light().faces, 5U);
}

TEST_F(GltfSceneTest, MeshLightsAreOfSceneFiles) {
  own() = {{"type", "mesh"}, {"file", "tube.obj"}};
  EXPECT_EQ(fault(), "level.gltf:nodes[1].extras.pdsm_light.type: mesh is for lights of scene files");
}

TEST_F(GltfSceneTest, WhatHasNoSizeIsLeftOutAndTold) {
  json& punctual = extension("KHR_lights_punctual");
  punctual = {{"type", "directional"}};
  EXPECT_EQ(warning(),
            "level.gltf: nodes[1] (Lamp): left out: a directional light without angle in its extras");
  punctual = {{"type", "spot"}, {"spot", json::object()}};
  EXPECT_EQ(warning(), "level.gltf: nodes[1] (Lamp): left out: a spot light without radius in its extras");
  punctual = {{"type", "point"}};
  EXPECT_EQ(warning(), "level.gltf: nodes[1] (Lamp): left out: a point light without radius in its extras");
}

TEST_F(GltfSceneTest, PointLightsWithARadiusAreSpheres) {
  extension("KHR_lights_punctual") = {{"type", "point"}, {"extras", {{"radius", 0.25}}}};
  EXPECT_EQ(std::get<SphereLight>(light().shape).radius, 0.25);
  EXPECT_EQ(view_count(light()), 6U);
}

TEST_F(GltfSceneTest, OwnLightsComeFirst) {
  extension("KHR_lights_punctual") = {{"type", "directional"}, {"extras", {{"angle", 2}}}};
  extension("EXT_lights_area") = {{"type", "disk"}};
  EXPECT_TRUE(std::holds_alternative<DiskLight>(light().shape));
  own() = {{"type", "rect"}, {"width", 1}, {"height", 1}};
  EXPECT_TRUE(std::holds_alternative<RectLight>(light().shape));
}

TEST_F(GltfSceneTest, FaultsNameTheirField) {
  own() = {{"type", "rect"}, {"width", 1}};
  EXPECT_EQ(fault(), "level.gltf:nodes[1].extras.pdsm_light.height: is missing");
  for (const char* key : {"position", "direction", "up"}) {
    own() = {{"type", "disk"}, {"radius", 1}, {key, {0, 1, 0}}};
    EXPECT_EQ(fault(),
              std::string("level.gltf:nodes[1].extras.pdsm_light.") + key + ": is given by the node");
  }
  own() = {{"type", "disk"}, {"radius", 1}, {"colour", "red"}};
  EXPECT_EQ(fault().find("level.gltf:nodes[1].extras.pdsm_light.colour: unknown key"), 0U);
  own() = 7;
  EXPECT_EQ(fault(), "level.gltf:nodes[1].extras.pdsm_light: must be an object");
  own() = {{"type", "disk"}, {"radius", 1}};
  node()["scale"] = {0, 0, 0};
  EXPECT_EQ(fault(), "level.gltf:nodes[1]: its transform leaves its light no direction or place");
}

TEST_F(GltfSceneTest, ListsMustHoldWhatNodesName) {
  extension("KHR_lights_punctual") = {{"type", "point"}};
  const std::string refused =
      "level.gltf:nodes[1].extensions.KHR_lights_punctual.light: must be the place of a light in the list of "
      "KHR_lights_punctual";
  for (const json& place : {json(1), json(-1), json("0"), json(0.5), json(1e30)}) {
    node()["extensions"]["KHR_lights_punctual"]["light"] = place;
    EXPECT_EQ(fault(), refused) << place;
  }
  gltf_.erase("extensions");
  node()["extensions"]["KHR_lights_punctual"]["light"] = 0;
  EXPECT_EQ(fault(), refused);
}

TEST_F(GltfSceneTest, PackedAndInAnyCase) {
  own() = {{"type", "disk"}, {"radius", 1}};
  const std::string file = folder_.write("LEVEL.GLTF.gz", "").string();
  const std::string text = gltf_.dump();
  gzFile packed = gzopen(file.c_str(), "wb");
  ASSERT_EQ(gzwrite(packed, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
  gzclose(packed);
  EXPECT_EQ(read_scene(file).lights.size(), 1U);
}

TEST_F(GltfSceneTest, AsGeometryItsLightsAreLeftAlone) {
  own() = {{"type", "no such light"}};
  folder_.write("level.gltf", gltf_.dump());
  const Scene scene = folder_.read(scene_of("level.gltf"));
  EXPECT_EQ(scene.geometry.size(), 1U);
  EXPECT_TRUE(scene.lights.empty());
}

TEST_F(GltfSceneTest, TheSameLightAsASceneFileHas) {
  own() = {{"type", "rect"}, {"width", 3}, {"height", 2}};
  node()["translation"] = {0, 5, 0};
  node()["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  const Scene there = folder_.read(
      R"({"lights": [{"type": "rect", "width": 3, "height": 2, "position": [0,5,0], "direction": [0,-1,0],
          "up": [0,0,-1]}]})");
  const RigidTransform a = light_frame(light()), b = light_frame(there.lights.at(0));
  for (std::size_t n = 0; n < 9; ++n) EXPECT_NEAR(a.rotation[n], b.rotation[n], 1e-12) << n;
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(a.translation[n], b.translation[n], 1e-11) << n;
}

}  // namespace
}  // namespace pdsm::test
