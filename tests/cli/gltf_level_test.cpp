// SPDX-License-Identifier: Apache-2.0
// A glTF file as the scene of every command that takes one.
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "scratch_scene.h"

namespace pdsm {
namespace {

using Json = nlohmann::json;

/// Corners of the triangles of two squares at y = 1 and y = 0, as plate.obj and floor.obj have them.
std::string squares() {
  std::vector<float> corners;
  for (const auto& [half, y] : {std::pair{1.0F, 1.0F}, {9.0F, 0.0F}}) {
    const std::array<std::array<float, 2>, 6> square{{{-1, -1}, {-1, 1}, {1, 1}, {-1, -1}, {1, 1}, {1, -1}}};
    for (const auto& [x, z] : square) corners.insert(corners.end(), {x * half, y, z * half});
  }
  std::string bytes(corners.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), corners.data(), bytes.size());
  return bytes;
}

/// A folder with level.gltf: what one.scene.json has.
class GltfLevel : public ScratchScene {
 protected:
  GltfLevel() {
    write_file("level.bin", squares());
    const auto mesh = [](int accessor) {
      return Json{{"primitives", {{{"attributes", {{"POSITION", accessor}}}}}}};
    };
    const auto accessor = [](int offset) {
      return Json{
          {"bufferView", 0}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 6}, {"type", "VEC3"}};
    };
    // Blender's down: -Z turned to -Y, +Y to +Z.
    const std::vector<int> downwards{-1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 4, 0, 1};
    const Json light{{"type", "rect"}, {"width", 1}, {"height", 1}};
    const Json level{{"asset", {{"version", "2.0"}}},
                     {"nodes",
                      {{{"mesh", 0}},
                       {{"mesh", 1}},
                       {{"name", "key"}, {"matrix", downwards}, {"extras", {{"pdsm_light", light}}}}}},
                     {"meshes", {mesh(0), mesh(1)}},
                     {"buffers", {{{"uri", "level.bin"}, {"byteLength", 144}}}},
                     {"bufferViews", {{{"buffer", 0}, {"byteLength", 144}}}},
                     {"accessors", {accessor(0), accessor(72)}}};
    write_file("level.gltf", level.dump());
  }
};

TEST_F(GltfLevel, IsBakedAsItsSceneFileIs) {
  expect_exit(run({"bake", "level.gltf", "-o", "gltf.pdsm", "--samples", "16", "--resolution", "32"}), 0);
  expect_exit(run({"bake", "one.scene.json", "-o", "json.pdsm", "--samples", "16", "--resolution", "32"}), 0);
  EXPECT_EQ(contents("gltf.pdsm"), contents("json.pdsm"));
}

TEST_F(GltfLevel, IsALevel) {
  Json level = Json::parse(contents("level.gltf"));
  level["nodes"].push_back({{"name", "Sun.001"},
                            {"matrix", level["nodes"][2]["matrix"]},
                            {"extras", {{"pdsm_light", {{"type", "distant"}}}}}});
  write_file("level.gltf", level.dump());
  const std::vector<std::string> bake{"bake", "level.gltf",   "-o", "maps",     "--samples",
                                      "16",   "--resolution", "32", "--report", "r.json"};
  expect_exit(run(bake), 0);
  EXPECT_EQ(Json::parse(contents("maps/manifest.json"))["lights"].size(), 2U);
  EXPECT_TRUE(exists("maps/key.pdsm") && exists("maps/Sun_001.pdsm"));
  expect_exit(run(bake), 0);
  EXPECT_EQ(Json::parse(contents("r.json"))["Sun_001"]["status"], "unchanged");
}

TEST_F(GltfLevel, IsTakenByEveryCommand) {
  bake_small("key.pdsm");
  expect_exit(run({"verify", "key.pdsm", "level.gltf", "--points", "100", "--samples", "64"}), 0);
  RunSetup point;
  point.input = "0 0 0\n";
  const Outcome truth = run({"truth", "level.gltf", "--samples", "64"}, point);
  expect_exit(truth, 0);
  // The whole light is behind the plate.
  EXPECT_EQ(truth.out, "1\n");
  expect_exit(run({"render", "key.pdsm", "level.gltf", "-o", "a.png", "--size", "32x32"}), 0);
}

TEST_F(GltfLevel, WithoutLightsIsABadScene) {
  Json whole = Json::parse(contents("level.gltf"));
  whole["nodes"][2].erase("extras");
  write_file("level.gltf", whole.dump());
  expect_exit(run({"bake", "level.gltf", "-o", "maps"}), 3);
}

}  // namespace
}  // namespace pdsm
