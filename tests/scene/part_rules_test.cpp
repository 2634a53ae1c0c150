// SPDX-License-Identifier: Apache-2.0
// Rules for nodes and materials of geometry files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "scene_folder.h"

namespace pdsm::test {
namespace {

using nlohmann::json;

/// level.gltf: `wall` (brick), and below `props` the nodes `crate` (wood) and `Crate.001` (glass); one
/// triangle each.
class PartRules : public testing::Test {
 protected:
  PartRules() {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::string bytes(corners.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), corners.data(), bytes.size());
    folder_.write("level.bin", bytes);
    gltf_ = json::parse(R"({
      "asset": {"version": "2.0"},
      "scenes": [{"nodes": [0, 1]}],
      "nodes": [{"name": "wall", "mesh": 0}, {"name": "props", "children": [2, 3]}, {"name": "crate", "mesh": 1},
                {"name": "Crate.001", "mesh": 2}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                 {"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]},
                 {"primitives": [{"attributes": {"POSITION": 0}, "material": 2}]}],
      "materials": [{"name": "brick"}, {"name": "wood"}, {"name": "glass"}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"uri": "level.bin", "byteLength": 36}]})");
    folder_.write("level.gltf", gltf_.dump());
  }

  /// A letter for each part that casts, in upper case where it receives; '-' where it does neither and '.'
  /// where it receives alone.
  std::string told(const std::string& rules, const std::string& more = "") {
    const Scene scene = folder_.read(scene_of("level.gltf", more + R"("parts": )" + rules));
    std::string text;
    for (const Geometry& part : scene.geometry) {
      const char letter = part.name.at(std::strlen("level.gltf:"));
      const int cast = part.receives ? std::toupper(letter) : std::tolower(letter);
      text += part.casts ? static_cast<char>(cast) : (part.receives ? '.' : '-');
    }
    return text;
  }

  std::string fault_of(const std::string& rules) {
    return folder_.fault_of(scene_of("level.gltf", R"("parts": )" + rules));
  }

  json gltf_;
  SceneFolder folder_;
};

TEST_F(PartRules, FitNodesAndWhatIsBelowThem) {
  EXPECT_EQ(told("[]"), "WCC");
  EXPECT_EQ(told(R"([{"node": "wall", "receives": false}])"), "wCC");
  EXPECT_EQ(told(R"([{"node": "props", "casts": false}])"), "W..");
  EXPECT_EQ(told(R"([{"node": "crate", "casts": false, "receives": false}])"), "W-C");
}

TEST_F(PartRules, FitMaterials) {
  EXPECT_EQ(told(R"([{"material": "glass", "casts": false}])"), "WC.");
  EXPECT_EQ(told(R"([{"node": "props", "material": "wood", "receives": false}])"), "WcC");
}

TEST_F(PartRules, TakePatterns) {
  EXPECT_EQ(told(R"([{"node": "?rate*", "receives": false}])"), "Wcc");
  EXPECT_EQ(told(R"([{"node": "Crate.00[1-4]", "receives": false}])"), "WCc");
  EXPECT_EQ(told(R"([{"material": "*", "receives": false}])"), "wcc");
}

TEST_F(PartRules, GoInOrderOverTheEntrysOwn) {
  EXPECT_EQ(told(R"([{"node": "*", "casts": false}, {"node": "wall", "casts": true}])"), "W..");
  EXPECT_EQ(told(R"([{"node": "wall", "casts": true}, {"node": "*", "casts": false}])"), "...");
  EXPECT_EQ(told(R"([{"node": "wall", "casts": true}])", R"("casts": false, "receives": false, )"), "w--");
}

TEST_F(PartRules, OpacityGoesOverTheMaterialsAndTheEntrys) {
  gltf_["materials"][2] = {{"name", "glass"},
                           {"alphaMode", "BLEND"},
                           {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.25}}}}};
  folder_.write("level.gltf", gltf_.dump());
  const Scene scene = folder_.read(
      scene_of("level.gltf", R"("opacity": 0.5, "parts": [{"material": "wood", "opacity": 0.75}])"));
  ASSERT_EQ(scene.geometry.size(), 3U);
  EXPECT_EQ(scene.geometry[0].opacity, 0.5);
  EXPECT_EQ(scene.geometry[1].opacity, 0.75);
  EXPECT_EQ(scene.geometry[2].opacity, 0.125);
  EXPECT_EQ(folder_.read(scene_of("level.gltf", R"("parts": [{"material": "glass", "opacity": 1}])"))
                .geometry[2]
                .opacity,
            1);
  EXPECT_EQ(fault_of(R"([{"node": "wall", "opacity": 1.5}])"),
            "level.scene.json:geometry[0].parts[0].opacity: must be a number from 0 to 1");
}

TEST_F(PartRules, TransmissionGoesOverTheEntrys) {
  const Scene scene = folder_.read(
      scene_of("level.gltf",
               R"("transmission": 0.5, "parts": [{"material": "glass", "transmission": [0.9, 0.1, 0]}])"));
  ASSERT_EQ(scene.geometry.size(), 3U);
  EXPECT_EQ(scene.geometry[0].transmission, glm::dvec3(0.5));
  EXPECT_EQ(scene.geometry[2].transmission, glm::dvec3(0.9, 0.1, 0));
  for (const char* bad : {"1.5", "[0.5, 0.5]", "[0, 0, -1]", "\"red\""})
    EXPECT_EQ(fault_of(R"([{"node": "wall", "transmission": )" + std::string(bad) + "}]"),
              "level.scene.json:geometry[0].parts[0].transmission: must be a number from 0 to 1, or three of "
              "them: red, green and blue");
}

TEST_F(PartRules, AreForOneEntryAlone) {
  const Scene scene = folder_.read(
      R"({"geometry": [{"file": "level.gltf", "parts": [{"node": "*", "casts": false}]}, {"file": "level.gltf"}]})");
  ASSERT_EQ(scene.geometry.size(), 6U);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(scene.geometry[n].casts, n >= 3) << n;
}

TEST_F(PartRules, ObjObjectsAreNodes) {
  folder_.write("a.mtl", "newmtl brick\nKd 1 0 0\nnewmtl tiles\nKd 0 1 0\n");
  folder_.write("level.gltf", gltf_.dump());
  folder_.write("a.obj",
                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no wall\nusemtl brick\nf 1 2 3\no roof\nusemtl "
                "tiles\nf 3 2 1\n");
  const auto casts = [&](const std::string& rule) {
    const Scene scene = folder_.read(scene_of("a.obj", R"("parts": [)" + rule + "]"));
    std::map<std::string, bool> found;
    for (const Geometry& part : scene.geometry) found[part.name] = part.casts;
    return found;
  };
  const std::map<std::string, bool> expected{{"a.obj:wall", true}, {"a.obj:roof", false}};
  EXPECT_EQ(casts(R"({"node": "roof", "casts": false})"), expected);
  EXPECT_EQ(casts(R"({"material": "tiles", "casts": false})"), expected);
}

TEST_F(PartRules, ThatFitNothingAreFaults) {
  EXPECT_EQ(fault_of(R"([{"node": "wall", "casts": false}, {"node": "Wall", "casts": false}])"),
            "level.scene.json:geometry[0].parts[1]: fits no part of the file");
  EXPECT_EQ(fault_of(R"([{"node": "wall", "material": "wood", "casts": false}])"),
            "level.scene.json:geometry[0].parts[0]: fits no part of the file");
}

TEST_F(PartRules, ThatSayNothingAreFaults) {
  const std::string place = "level.scene.json:geometry[0].parts";
  EXPECT_EQ(fault_of(R"([{"casts": false}])"),
            place + "[0].node: or material must tell what the rule is for");
  EXPECT_EQ(fault_of(R"([{"node": "wall"}])"),
            place + "[0].casts: or receives, opacity or transmission must be there");
  EXPECT_EQ(fault_of(R"([{"node": "", "casts": false}])"),
            place + "[0].node: must be a name, or a pattern of one");
  EXPECT_EQ(fault_of(R"([{"nodes": "wall", "casts": false}])").rfind(place + "[0].nodes: unknown key", 0),
            0U);
  EXPECT_EQ(fault_of(R"([7])").rfind(place + "[0]: ", 0), 0U);
  EXPECT_EQ(fault_of(R"({"node": "wall"})").rfind(place + ": ", 0), 0U);
}

// A file of nodes within nodes is read in the time that its length takes.
TEST_F(PartRules, DeepNodesAreReadAllTheSame) {
  constexpr int kDepth = 20000;
  gltf_["scenes"] = {{{"nodes", {0}}}};
  gltf_["nodes"] = json::array();
  for (int n = 0; n < kDepth; ++n) {
    json node{{"name", "n" + std::to_string(n)}, {"mesh", 0}};
    if (n + 1 < kDepth) node["children"] = {n + 1};
    gltf_["nodes"].push_back(std::move(node));
  }
  folder_.write("level.gltf", gltf_.dump());
  const auto casting = [&](const std::string& node) {
    const Scene scene =
        folder_.read(scene_of("level.gltf", R"("parts": [{"node": ")" + node + R"(", "casts": false}])"));
    return std::ranges::count_if(scene.geometry, [](const Geometry& part) { return part.casts; });
  };
  // A node and the 63 below it that know of it.
  EXPECT_EQ(casting("n100"), kDepth - 64);
  EXPECT_EQ(casting("n19999"), kDepth - 1);
}

}  // namespace
}  // namespace pdsm::test
