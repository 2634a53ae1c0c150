// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

using nlohmann::json;

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A unit tetrahedron's corners, and its faces as seen from outside.
const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint16_t> kFaces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

/// A glTF file of one mesh under one node, to be varied by the tests.
class GltfTest : public testing::Test {
 protected:
  GltfTest() {
    gltf_ = {{"asset", {{"version", "2.0"}}},
             {"scene", 0},
             {"scenes", {{{"nodes", {0}}}}},
             {"nodes", {{{"mesh", 0}, {"name", "tetra"}}}},
             {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}}};
    buffer_ = bytes_of(kCorners) + bytes_of(kFaces);
    gltf_["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                            {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 24}}};
    gltf_["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                          {{"bufferView", 1}, {"componentType", 5123}, {"count", 12}, {"type", "SCALAR"}}};
  }

  json& primitive() { return gltf_["meshes"][0]["primitives"][0]; }

  /// Positions as floats and no indices.
  void set_corners(const std::vector<float>& corners, int mode) {
    buffer_ = bytes_of(corners);
    gltf_["bufferViews"] = {{{"buffer", 0}, {"byteLength", buffer_.size()}}};
    gltf_["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"count", corners.size() / 3}, {"type", "VEC3"}}};
    primitive().erase("indices");
    primitive()["mode"] = mode;
  }

  void write() {
    gltf_["buffers"] = {{{"uri", "a.bin"}, {"byteLength", buffer_.size()}}};
    folder_.write("a.bin", buffer_);
    folder_.write("a.gltf", gltf_.dump());
  }

  std::vector<Geometry> import() {
    write();
    return import_geometry(folder_.path() / "a.gltf");
  }

  std::string fault() {
    write();
    return folder_.import_fault_of("a.gltf");
  }

  SceneFolder folder_;
  json gltf_;
  std::string buffer_;
};

TEST_F(GltfTest, IndexedTriangles) {
  const std::vector<Geometry> parts = import();
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].name, "a.gltf");
  EXPECT_TRUE(parts[0].mesh->closed);
  EXPECT_NEAR(signed_volume(parts[0]), 1.0 / 6, 1e-12);
  EXPECT_EQ(parts[0].base_color, Geometry{}.base_color);
}

/// Adds an attribute of instances, as accessor `index`.
void add_attribute(json& gltf, std::string& buffer, const char* name, const std::vector<float>& values,
                   int axes) {
  const std::size_t index = gltf["accessors"].size();
  gltf["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", 4 * values.size()}});
  gltf["accessors"].push_back({{"bufferView", index},
                               {"componentType", 5126},
                               {"count", values.size() / static_cast<std::size_t>(axes)},
                               {"type", axes == 3 ? "VEC3" : "VEC4"}});
  buffer += bytes_of(values);
  gltf["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"][name] = index;
}

TEST_F(GltfTest, InstancesOfAMesh) {
  gltf_["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  gltf_["nodes"][0]["translation"] = {0, 0, 7};
  add_attribute(gltf_, buffer_, "TRANSLATION", {1, 0, 0, 0, 5, 0}, 3);
  add_attribute(gltf_, buffer_, "SCALE", {1, 1, 1, 2, 2, 2}, 3);
  // Half a turn about z, and none.
  add_attribute(gltf_, buffer_, "ROTATION", {0, 0, 1, 0, 0, 0, 0, 1}, 4);
  const std::vector<Geometry> parts = import();
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].mesh, parts[1].mesh);
  const auto at = [&](std::size_t n) { return glm::dvec3(parts[n].local_to_world * glm::dvec4(1, 0, 0, 1)); };
  EXPECT_EQ(at(0), glm::dvec3(0, 0, 7));
  EXPECT_EQ(at(1), glm::dvec3(2, 5, 7));
}

TEST_F(GltfTest, InstancesThatCannotBe) {
  add_attribute(gltf_, buffer_, "TRANSLATION", {1, 0, 0, 0, 5, 0}, 3);
  const json good = gltf_;
  add_attribute(gltf_, buffer_, "SCALE", {1, 1, 1}, 3);
  EXPECT_NE(fault().find("attributes of different lengths"), std::string::npos);
  gltf_ = good;
  json& extension = gltf_["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
  for (const json& index : {json(-1), json("0"), json(1.5)}) {
    extension["attributes"]["TRANSLATION"] = index;
    EXPECT_NE(fault().find("an attribute that is no accessor"), std::string::npos) << index;
  }
  extension["attributes"]["TRANSLATION"] = 99;
  EXPECT_NE(fault().find("accessors[99] does not exist"), std::string::npos);
  extension.erase("attributes");
  extension["other"] = 1;
  EXPECT_NE(fault().find("has no attributes"), std::string::npos);
}

TEST_F(GltfTest, IndicesOfEveryWidth) {
  const std::vector<std::uint8_t> narrow(kFaces.begin(), kFaces.end());
  const std::vector<std::uint32_t> wide(kFaces.begin(), kFaces.end());
  for (const auto& [type, bytes] : {std::pair{5121, bytes_of(narrow)}, std::pair{5125, bytes_of(wide)}}) {
    buffer_ = bytes_of(kCorners) + bytes;
    gltf_["bufferViews"][1]["byteLength"] = bytes.size();
    gltf_["accessors"][1]["componentType"] = type;
    EXPECT_NEAR(signed_volume(import().at(0)), 1.0 / 6, 1e-12) << type;
  }
}

TEST_F(GltfTest, PositionsWithStrideAndOffset) {
  buffer_ = "jump";
  for (std::size_t i = 0; i < 4; ++i) {
    buffer_ += std::string(4, '\xff') +
               bytes_of(std::vector<float>(kCorners.begin() + static_cast<long>(3 * i),
                                           kCorners.begin() + static_cast<long>(3 * i + 3)));
  }
  buffer_ += bytes_of(kFaces);
  gltf_["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 4}, {"byteLength", 64}, {"byteStride", 16}},
                          {{"buffer", 0}, {"byteOffset", 68}, {"byteLength", 24}}};
  gltf_["accessors"][0]["byteOffset"] = 4;
  EXPECT_NEAR(signed_volume(import().at(0)), 1.0 / 6, 1e-12);
}

TEST_F(GltfTest, QuantisedPositions) {
  const std::vector<std::int16_t> corners{0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0};
  buffer_ = bytes_of(corners) + bytes_of(kFaces);
  gltf_["extensionsRequired"] = {"KHR_mesh_quantization"};
  gltf_["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 32}, {"byteStride", 8}},
                          {{"buffer", 0}, {"byteOffset", 32}, {"byteLength", 24}}};
  gltf_["accessors"][0]["componentType"] = 5122;
  gltf_["accessors"][0]["normalized"] = true;
  EXPECT_NEAR(signed_volume(import().at(0)), 1.0 / 6, 1e-12);
  gltf_["accessors"][0]["normalized"] = false;
  EXPECT_NEAR(signed_volume(import().at(0)), 32767.0 * 32767 * 32767 / 6, 1);
}

TEST_F(GltfTest, StripsFansAndPlainTriangles) {
  // A unit square in the plane z = 0, facing +z, in each of the three modes.
  const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<float> plain{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  for (const auto& [mode, corners] : {std::pair{4, plain}, std::pair{5, strip}, std::pair{6, fan}}) {
    set_corners(corners, mode);
    const std::vector<Geometry> parts = import();
    ASSERT_EQ(parts.size(), 1U) << mode;
    double area = 0;
    for (const glm::uvec3& t : parts[0].mesh->triangles) {
      const auto& p = parts[0].mesh->positions;
      const float twice = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).z;
      EXPECT_GT(twice, 0) << mode;
      area += twice / 2;
    }
    EXPECT_EQ(area, 1) << mode;
  }
  // A fan of three triangles, in the shape of a house.
  set_corners({0, 0, 0, 1, 0, 0, 1, 1, 0, 0.5, 1.5, 0, 0, 1, 0}, 6);
  const Geometry house = import().at(0);
  double area = 0;
  for (const glm::uvec3& t : house.mesh->triangles) {
    const auto& p = house.mesh->positions;
    area += glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).z / 2;
  }
  EXPECT_EQ(area, 1.25);
  // Points and lines have no surface.
  for (const int mode : {0, 1, 2, 3}) {
    set_corners(plain, mode);
    EXPECT_TRUE(import().empty()) << mode;
  }
}

TEST_F(GltfTest, NodesAreNested) {
  // The child is turned by 90 degrees about z, doubled and moved; its parent moves and mirrors.
  const double h = std::sqrt(0.5);
  gltf_["nodes"] = {
      {{"children", {1}}, {"translation", {10, 0, 0}}, {"scale", {1, 1, -1}}},
      {{"mesh", 0}, {"rotation", {0, 0, h, h}}, {"scale", {2, 2, 2}}, {"translation", {0, 0, 5}}}};
  const std::vector<Geometry> parts = import();
  ASSERT_EQ(parts.size(), 1U);
  const auto image = [&](double x, double y, double z) {
    return glm::dvec3(parts[0].local_to_world * glm::dvec4(x, y, z, 1));
  };
  EXPECT_LT(glm::length(image(1, 0, 0) - glm::dvec3(10, 2, -5)), 1e-14);
  EXPECT_LT(glm::length(image(0, 1, 1) - glm::dvec3(8, 0, -7)), 1e-14);
  // Mirrored by its parent, it still faces outwards.
  EXPECT_NEAR(signed_volume(parts[0]), 8.0 / 6, 1e-12);
}

TEST_F(GltfTest, NodeMatrixIsByColumns) {
  gltf_["nodes"][0]["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1};
  const Geometry part = import().at(0);
  EXPECT_EQ(glm::dvec3(part.local_to_world * glm::dvec4(1, 0, 0, 1)), glm::dvec3(7, 10, 9));
}

TEST_F(GltfTest, MeshUnderTwoNodesIsShared) {
  gltf_["scenes"][0]["nodes"] = {0, 1};
  gltf_["nodes"] = {{{"mesh", 0}, {"name", "one"}},
                    {{"mesh", 0}, {"name", "two"}, {"translation", {5, 0, 0}}}};
  const std::vector<Geometry> parts = import();
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].mesh, parts[1].mesh);
  EXPECT_EQ(parts[0].name, "a.gltf:one");
  EXPECT_EQ(parts[1].name, "a.gltf:two");
}

TEST_F(GltfTest, OnlyTheDefaultSceneCounts) {
  gltf_["scenes"] = {{{"nodes", json::array()}}, {{"nodes", {0}}}};
  EXPECT_TRUE(import().empty());
  gltf_["scene"] = 1;
  EXPECT_EQ(import().size(), 1U);
}

TEST_F(GltfTest, BaseColorFactorAndNoImages) {
  primitive()["material"] = 0;
  gltf_["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
  gltf_["textures"] = {{{"source", 0}}};
  gltf_["images"] = {{{"uri", "missing.png"}}};
  EXPECT_EQ(import().at(0).base_color, glm::vec3(0.5F, 0.25F, 0.125F));
}

TEST_F(GltfTest, BinaryFile) {
  gltf_["buffers"] = {{{"byteLength", buffer_.size()}}};
  std::string text = gltf_.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto u32 = [](std::size_t value) { return bytes_of(std::vector{static_cast<std::uint32_t>(value)}); };
  folder_.write("a.glb", "glTF" + u32(2) + u32(28 + text.size() + buffer_.size()) + u32(text.size()) +
                             "JSON" + text + u32(buffer_.size()) + std::string("BIN\0", 4) + buffer_);
  EXPECT_NEAR(signed_volume(import_geometry(folder_.path() / "a.glb").at(0)), 1.0 / 6, 1e-12);
}

TEST_F(GltfTest, NodeThatFlattensIsLeftOut) {
  gltf_["nodes"][0]["scale"] = {1, 0, 1};
  write();
  const Scene scene = folder_.read(scene_of("a.gltf"));
  EXPECT_TRUE(scene.geometry.empty());
  EXPECT_EQ(scene.warnings, std::vector<std::string>{"a.gltf: 4 triangles without area left out"});
}

TEST_F(GltfTest, IndicesOutOfRangeAreLeftOut) {
  buffer_[48] = 17;
  write();
  EXPECT_EQ(folder_.read(scene_of("a.gltf")).warnings,
            std::vector<std::string>{"a.gltf: 1 triangle with corners out of range left out"});
}

TEST_F(GltfTest, AccessorsStayWithinTheirBuffers) {
  gltf_["accessors"][0]["count"] = 5;
  EXPECT_EQ(fault(), "a.gltf: accessors[0] reaches past its bufferView");
  gltf_["accessors"][0]["count"] = 1000000000000000;
  EXPECT_EQ(fault(), "a.gltf: accessors[0] reaches past its buffer");
  gltf_["accessors"][0]["count"] = 4;
  gltf_["bufferViews"][0]["byteLength"] = 4800;
  gltf_["bufferViews"][0]["byteOffset"] = 40;
  EXPECT_EQ(fault(), "a.gltf: accessors[0] reaches past its buffer");
  gltf_["bufferViews"][0]["byteOffset"] = 0;
  EXPECT_EQ(fault(), "");
  gltf_["accessors"][0]["byteOffset"] = 28;
  EXPECT_EQ(fault(), "a.gltf: accessors[0] reaches past its buffer");
}

TEST_F(GltfTest, ThingsThatDoNotExist) {
  gltf_["nodes"][0]["mesh"] = 3;
  EXPECT_EQ(fault(), "a.gltf: meshes[3] does not exist");
  gltf_["nodes"][0] = {{"children", {7}}};
  EXPECT_EQ(fault(), "a.gltf: nodes[7] does not exist");
  gltf_["nodes"][0] = {{"mesh", 0}};
  primitive()["attributes"]["POSITION"] = 9;
  EXPECT_EQ(fault(), "a.gltf: accessors[9] does not exist");
}

TEST_F(GltfTest, NodesInACircleAreRefused) {
  gltf_["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
  EXPECT_EQ(fault(), "a.gltf: nodes[0] has more than one parent");
}

TEST_F(GltfTest, UnknownRequiredExtensionsAreRefused) {
  gltf_["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(fault(), "a.gltf: requires the extension KHR_draco_mesh_compression: not supported yet");
  gltf_["extensionsRequired"] = {"KHR_materials_unlit"};
  EXPECT_EQ(fault(), "");
}

TEST_F(GltfTest, BrokenFilesAreRefused) {
  write();
  const std::string text = gltf_.dump();
  for (std::size_t size = 0; size < text.size(); size += 7) {
    folder_.write("cut.gltf", text.substr(0, size));
    EXPECT_EQ(folder_.import_fault_of("cut.gltf").substr(0, 10), "cut.gltf: ") << size;
  }
  folder_.write("short.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12));
  EXPECT_EQ(folder_.import_fault_of("short.glb").substr(0, 11), "short.glb: ");
}

TEST_F(GltfTest, DeepNestingIsRefused) {
  const auto nested = [](std::size_t depth) {
    return "{\"asset\": {\"version\": \"2.0\", \"extras\": \"[[[\\\"[\"}, \"extras\": " +
           std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  folder_.write("a.gltf", nested(255));
  EXPECT_EQ(folder_.import_fault_of("a.gltf"), "");
  folder_.write("a.gltf", nested(256));
  EXPECT_EQ(folder_.import_fault_of("a.gltf"), "a.gltf: is nested too deeply");
  // Far deeper than any stack.
  const std::string text = nested(4'000'000);
  const auto word = [](std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&narrow), sizeof narrow);
  };
  folder_.write("a.glb", "glTF" + word(2) + word(20 + text.size()) + word(text.size()) + "JSON" + text);
  EXPECT_EQ(folder_.import_fault_of("a.glb"), "a.glb: is nested too deeply");
}

}  // namespace
}  // namespace pdsm::test
