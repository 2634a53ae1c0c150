// SPDX-License-Identifier: Apache-2.0
// Masks of glTF and OBJ files: which pictures they come from, and where corners lie in them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pdsm/format/error.h"
#include "scene_folder.h"
#include "test_pictures.h"

namespace pdsm::test {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// 2 x 2 pixels of RGBA with these alphas.
std::string alpha_png(const Bytes& alpha) {
  Bytes pixels;
  for (const std::uint8_t a : alpha) pixels.insert(pixels.end(), {10, 20, 30, a});
  return png(2, 2, 4, pixels);
}

const Bytes kAlpha{0, 100, 200, 255};

/// A triangle whose material cuts "leaf.png" out, to be varied by the tests.
class GltfCutout : public testing::Test {
 protected:
  GltfCutout() {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0}, places{0, 0, 1, 0, 0.25F, 0.75F},
        other_places{5, 5, 6, 5, 5, 6};
    for (const std::vector<float>* values : {&corners, &places, &other_places})
      buffer_.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float));
    gltf_ = json::parse(R"({
      "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [0] } ], "nodes": [ { "mesh": 0 } ],
      "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2 }, "material": 0 } ] } ],
      "bufferViews": [ { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
                       { "buffer": 0, "byteOffset": 36, "byteLength": 24 },
                       { "buffer": 0, "byteOffset": 60, "byteLength": 24 } ],
      "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
                     { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" },
                     { "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2" } ],
      "materials": [ { "name": "leaf", "alphaMode": "MASK",
                       "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } } ],
      "textures": [ { "source": 0 } ], "images": [ { "uri": "leaf.png" } ] })");
    folder_.write("leaf.png", alpha_png(kAlpha));
  }

  json& material() { return gltf_["materials"][0]; }
  json& texture_info() { return material()["pbrMetallicRoughness"]["baseColorTexture"]; }

  void write() {
    gltf_["buffers"] = {{{"uri", "a.bin"}, {"byteLength", buffer_.size()}}};
    folder_.write("a.bin", buffer_);
    folder_.write("a.gltf", gltf_.dump());
  }
  Mesh import() {
    write();
    return *import_geometry(folder_.path() / "a.gltf").at(0).mesh;
  }
  std::string fault() {
    write();
    return folder_.import_fault_of("a.gltf");
  }
  Scene scene() {
    write();
    return folder_.read(scene_of("a.gltf"));
  }
  void expect_places(const std::vector<glm::vec2>& expected) {
    const Mesh mesh = import();
    ASSERT_EQ(mesh.mask_places.size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n) {
      EXPECT_NEAR(mesh.mask_places[n].x, expected[n].x, 1e-6) << n;
      EXPECT_NEAR(mesh.mask_places[n].y, expected[n].y, 1e-6) << n;
    }
  }

  SceneFolder folder_;
  json gltf_;
  std::string buffer_;
};

TEST_F(GltfCutout, HasMaskAndPlaces) {
  const Mesh mesh = import();
  ASSERT_NE(mesh.mask, nullptr);
  EXPECT_EQ(mesh.mask->width, 2U);
  EXPECT_EQ(mesh.mask->height, 2U);
  EXPECT_EQ(mesh.mask->alpha, kAlpha);
  EXPECT_EQ(mesh.mask->cutoff, 0.5F);
  EXPECT_EQ(mesh.mask->wrap, (std::array{MaskWrap::repeat, MaskWrap::repeat}));
  EXPECT_FALSE(mesh.closed);
  expect_places({{0, 0}, {1, 0}, {0.25F, 0.75F}});
}

TEST_F(GltfCutout, OpaqueCutsNothing) {
  material()["alphaMode"] = "OPAQUE";
  material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.6};
  EXPECT_EQ(import().mask, nullptr);
  EXPECT_TRUE(import().mask_places.empty());
  EXPECT_EQ(scene().geometry[0].opacity, 1);
}

TEST_F(GltfCutout, BlendIsOpacityTimesAlpha) {
  material()["alphaMode"] = "BLEND";
  material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.6};
  const Scene textured = scene();
  EXPECT_EQ(textured.geometry[0].opacity, 0.6);
  ASSERT_NE(textured.geometry[0].mesh->mask, nullptr);
  EXPECT_TRUE(textured.geometry[0].mesh->mask->blends);
  EXPECT_EQ(textured.geometry[0].mesh->mask->alpha, kAlpha);
  EXPECT_EQ(textured.geometry[0].mesh->mask_places.size(), 3U);
  material()["pbrMetallicRoughness"].erase("baseColorTexture");
  const Scene plain = scene();
  EXPECT_EQ(plain.geometry[0].opacity, 0.6);
  EXPECT_EQ(plain.geometry[0].mesh->mask, nullptr);
}

void let_through(json& material, const json& factor) {
  material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = factor;
}

TEST_F(GltfCutout, TransmissionIsColouredByTheBase) {
  material()["alphaMode"] = "OPAQUE";
  material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0.5, 0.25, 0.6};
  let_through(material(), 0.8);
  const Geometry textured = scene().geometry[0];
  EXPECT_EQ(textured.opacity, 1);
  EXPECT_EQ(textured.transmission, 0.8 * glm::dvec3(1, 0.5, 0.25));
  // Of an opaque material the picture's alpha means nothing; its colours are linear.
  ASSERT_NE(textured.mesh->mask, nullptr);
  EXPECT_TRUE(textured.mesh->mask->blends);
  EXPECT_EQ(textured.mesh->mask->alpha, std::vector<std::uint8_t>(kAlpha.size(), 255));
  EXPECT_EQ(textured.mesh->mask->transmission.size(), kAlpha.size());
  material()["alphaMode"] = "BLEND";
  EXPECT_EQ(scene().geometry[0].opacity, 0.6);
  EXPECT_EQ(import().mask->alpha, kAlpha);
  material()["alphaMode"] = "MASK";
  material()["alphaCutoff"] = 0.3;
  const std::vector<std::uint8_t> cut = import().mask->alpha;
  for (std::size_t n = 0; n < cut.size(); ++n) EXPECT_EQ(cut[n], kAlpha[n] >= 0.5 * 255 ? 255 : 0) << n;
  material()["pbrMetallicRoughness"].erase("baseColorTexture");
  material()["alphaMode"] = "OPAQUE";
  EXPECT_EQ(import().mask, nullptr);
  EXPECT_EQ(scene().geometry[0].transmission, 0.8 * glm::dvec3(1, 0.5, 0.25));
}

TEST_F(GltfCutout, TransmissionThatCannotBe) {
  for (const json& factor : {json(1.5), json(-1), json("much")}) {
    let_through(material(), factor);
    EXPECT_NE(fault().find("transmissionFactor must be from 0 to 1"), std::string::npos) << factor;
  }
  let_through(material(), 0.5);
  EXPECT_TRUE(scene().warnings.empty());
  json& texture = material()["extensions"]["KHR_materials_transmission"]["transmissionTexture"];
  texture = {{"index", 7}};
  EXPECT_NE(fault().find("textures[7] does not exist"), std::string::npos);
  texture = {{"index", "leaf"}};
  EXPECT_NE(fault().find("transmissionTexture: index is no integer"), std::string::npos);
  texture = {{"index", 0}, {"texCoord", 1}};
  ASSERT_EQ(scene().warnings.size(), 1U);
  EXPECT_NE(scene().warnings[0].find("transmissionTexture lies otherwise"), std::string::npos);
  EXPECT_EQ(scene().geometry[0].transmission, glm::dvec3(0.5));
}

TEST_F(GltfCutout, TransmissionTexturesMultiply) {
  // Red is the share, as it is.
  folder_.write("share.png", png(4, 1, 3, {255, 0, 0, 100, 9, 9, 51, 0, 7, 0, 255, 255}));
  gltf_["images"].push_back({{"uri", "share.png"}});
  gltf_["textures"].push_back({{"source", 1}});
  material()["alphaMode"] = "OPAQUE";
  material()["pbrMetallicRoughness"].erase("baseColorTexture");
  let_through(material(), 0.8);
  json& texture = material()["extensions"]["KHR_materials_transmission"]["transmissionTexture"];
  texture = {{"index", 1}};
  const Mesh alone = import();
  ASSERT_NE(alone.mask, nullptr);
  EXPECT_EQ(alone.mask->width, 4U);
  EXPECT_EQ(alone.mask->alpha, std::vector<std::uint8_t>(4, 255));
  EXPECT_EQ(alone.mask->transmission,
            (std::vector<glm::u8vec3>{glm::u8vec3(255), glm::u8vec3(100), glm::u8vec3(51), glm::u8vec3(0)}));
  EXPECT_EQ(alone.mask_places.size(), 3U);
  // Columns of a base that is half as wide are mixed between their centres, as light.
  folder_.write("base.png", png(2, 1, 3, {255, 255, 0, 0, 255, 0}));
  gltf_["images"].push_back({{"uri", "base.png"}});
  gltf_["textures"].push_back({{"source", 2}});
  material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 2}};
  EXPECT_EQ(import().mask->transmission,
            (std::vector<glm::u8vec3>{{255, 255, 0}, {75, 100, 0}, {13, 51, 0}, {0, 0, 0}}));
  EXPECT_TRUE(scene().warnings.empty());
}

TEST_F(GltfCutout, CutoffAndBaseColourFactor) {
  material()["alphaCutoff"] = 0.3;
  EXPECT_FLOAT_EQ(import().mask->cutoff, 0.3F);
  material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.6};
  EXPECT_FLOAT_EQ(import().mask->cutoff, 0.5F);
  // Nothing is left of a surface whose factor is 0.
  material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0};
  EXPECT_GT(import().mask->cutoff, 1);
  // All alphas are at least 0.
  material()["alphaCutoff"] = 0;
  EXPECT_EQ(import().mask, nullptr);
}

TEST_F(GltfCutout, AFactorWithoutTexture) {
  material()["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 1, 1, 0.5}}};
  EXPECT_EQ(import().mask, nullptr);
  material()["alphaCutoff"] = 0.6;
  const Mesh mesh = import();
  ASSERT_NE(mesh.mask, nullptr);
  EXPECT_GT(mesh.mask->cutoff, 1);
  EXPECT_EQ(mesh.mask_places.size(), 3U);
}

TEST_F(GltfCutout, WhatIsWholeHasNoMask) {
  folder_.write("leaf.png", alpha_png({128, 200, 255, 130}));
  EXPECT_EQ(import().mask, nullptr);
}

TEST_F(GltfCutout, APalettesTransparency) {
  folder_.write("leaf.png", palette_png(2, 2, {2, 0, 1, 2}, {7, 130, 255}));
  EXPECT_EQ(import().mask->alpha, (Bytes{255, 7, 130, 255}));
  EXPECT_TRUE(scene().warnings.empty());
}

TEST_F(GltfCutout, GreyAndAlpha) {
  folder_.write("leaf.png", png(2, 2, 2, {9, 0, 9, 100, 9, 200, 9, 255}));
  EXPECT_EQ(import().mask->alpha, kAlpha);
}

TEST_F(GltfCutout, WithoutAlphaItIsOpaqueWithAWarning) {
  for (const std::string& picture : {png(2, 2, 3, Bytes(12, 0)), png(2, 2, 1, Bytes(4, 0)), grey_jpeg(0)}) {
    folder_.write("leaf.png", picture);
    const Scene read = scene();
    EXPECT_EQ(read.geometry.at(0).mesh->mask, nullptr);
    ASSERT_EQ(read.warnings.size(), 1U);
    EXPECT_EQ(read.warnings[0], "a.gltf:leaf: image leaf.png has no alpha channel: nothing is cut out");
  }
}

TEST_F(GltfCutout, PicturesWithinTheFile) {
  const std::string picture = alpha_png(kAlpha);
  gltf_["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  EXPECT_EQ(import().mask->alpha, kAlpha);
  gltf_["images"] = {{{"bufferView", 3}, {"mimeType", "image/png"}}};
  gltf_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", picture.size()}});
  buffer_ += picture;
  EXPECT_EQ(import().mask->alpha, kAlpha);
}

TEST_F(GltfCutout, NamesWithPercents) {
  folder_.write("two words.png", alpha_png({1, 2, 3, 4}));
  gltf_["images"] = {{{"uri", "two%20words.png"}}};
  EXPECT_EQ(import().mask->alpha, (Bytes{1, 2, 3, 4}));
}

TEST_F(GltfCutout, PicturesBesideAreFilesOfTheScene) {
  const Scene read = scene();
  ASSERT_EQ(read.files.size(), 4U);
  EXPECT_EQ(read.files[3].filename(), "leaf.png");
  // Only those that are needed.
  material()["alphaMode"] = "OPAQUE";
  EXPECT_EQ(scene().files.size(), 3U);
}

TEST_F(GltfCutout, WrapModes) {
  texture_info();
  gltf_["textures"][0]["sampler"] = 0;
  for (const auto& [mode, wrap] : {std::pair{10497, MaskWrap::repeat}, std::pair{33071, MaskWrap::clamp},
                                   std::pair{33648, MaskWrap::mirror}}) {
    gltf_["samplers"] = {{{"wrapS", mode}}};
    EXPECT_EQ(import().mask->wrap, (std::array{wrap, MaskWrap::repeat}));
    gltf_["samplers"] = {{{"wrapT", mode}}};
    EXPECT_EQ(import().mask->wrap, (std::array{MaskWrap::repeat, wrap}));
  }
}

TEST_F(GltfCutout, ASecondSetOfPlaces) {
  texture_info()["texCoord"] = 1;
  expect_places({{5, 5}, {6, 5}, {5, 6}});
}

TEST_F(GltfCutout, QuantisedPlaces) {
  gltf_["accessors"][1] = {
      {"bufferView", 1}, {"componentType", 5123}, {"normalized", true}, {"count", 3}, {"type", "VEC2"}};
  const std::vector<std::uint16_t> places{0, 0, 65535, 0, 0, 65535};
  std::memcpy(buffer_.data() + 36, places.data(), 12);
  expect_places({{0, 0}, {1, 0}, {0, 1}});
}

/// Scaled, then turned counter-clockwise as seen on the image, whose v points down, then moved.
TEST_F(GltfCutout, TextureTransform) {
  texture_info()["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.5, 0.25}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}};
  // (u, v) -> (3 v + 0.5, -2 u + 0.25).
  expect_places({{0.5F, 0.25F}, {0.5F, -1.75F}, {2.75F, -0.25F}});
  texture_info()["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
  expect_places({{5, 5}, {6, 5}, {5, 6}});
}

TEST_F(GltfCutout, IsNeverClosed) {
  // A triangle and its back.
  Mesh mesh = import();
  mesh.triangles.push_back({0, 2, 1});
  EXPECT_FALSE(is_closed(mesh));
  mesh.mask = nullptr;
  mesh.mask_places.clear();
  EXPECT_TRUE(is_closed(mesh));
}

TEST_F(GltfCutout, BrokenOrMissingPicturesAreRefused) {
  gltf_["images"] = {{{"uri", "none.png"}}};
  EXPECT_EQ(fault(), "a.gltf:leaf: none.png: no such file");
  gltf_["images"] = {{{"uri", "leaf.png"}}};
  const std::string good = alpha_png(kAlpha);
  for (const std::string& broken : {std::string(), std::string("leaf"), good.substr(0, 50)}) {
    folder_.write("leaf.png", broken);
    EXPECT_TRUE(
        fault().starts_with("a.gltf:leaf: image leaf.png: is not a PNG, JPEG or TGA picture that can "
                            "be read ("))
        << fault();
  }
  gltf_["images"] = {{{"bufferView", 9}, {"mimeType", "image/png"}}};
  EXPECT_NE(fault(), "");
}

TEST_F(GltfCutout, WhatMakesNoSenseIsRefused) {
  const json good = gltf_;
  const auto fault_after = [&](const std::function<void(json&)>& spoil) {
    gltf_ = good;
    spoil(gltf_);
    return fault();
  };
  EXPECT_EQ(fault_after([](json& g) { g["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0"); }),
            "a.gltf:leaf: a primitive has no TEXCOORD_0");
  EXPECT_EQ(fault_after([](json& g) { g["accessors"][1]["count"] = 2; }),
            "a.gltf:leaf: a primitive has 2 TEXCOORD_0 for 3 positions");
  EXPECT_EQ(fault_after([](json& g) { g["accessors"][1]["type"] = "SCALAR"; }),
            "a.gltf:leaf: accessors[1] is not VEC2");
  EXPECT_EQ(fault_after([](json& g) { g["textures"][0]["source"] = 4; }),
            "a.gltf:leaf: images[4] does not exist");
  EXPECT_EQ(fault_after([](json& g) { g["textures"][0].erase("source"); }),
            "a.gltf:leaf: its texture has no image that can be read");
  EXPECT_EQ(fault_after([](json& g) {
              g["textures"][0]["sampler"] = 0;
              g["samplers"] = {{{"wrapS", 5}}};
            }),
            "a.gltf:leaf: wrap mode 5 is unknown");
  EXPECT_EQ(fault_after([](json& g) {
              g["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, -1};
            }),
            "a.gltf:leaf: baseColorFactor must be from 0 to 1");
  EXPECT_EQ(fault_after([](json& g) {
              g["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
               ["KHR_texture_transform"] = {{"scale", {1}}};
            }),
            "a.gltf:leaf: KHR_texture_transform: scale is not a pair of numbers");
}

/// An OBJ file of one triangle, with a material.
class ObjCutout : public testing::Test {
 protected:
  ObjCutout() {
    folder_.write("leaf.png", alpha_png(kAlpha));
    folder_.write("a.obj",
                  "mtllib a.mtl\nusemtl leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.25 0.75\n"
                  "f 1/1 2/2 3/3\n");
  }
  void set_material(const std::string& lines) { folder_.write("a.mtl", "newmtl leaf\nKd 1 1 1\n" + lines); }
  Mesh import() const { return *import_geometry(folder_.path() / "a.obj").at(0).mesh; }

  SceneFolder folder_;
};

TEST_F(ObjCutout, HasMaskAndPlaces) {
  set_material("map_d leaf.png\n");
  const Mesh mesh = import();
  ASSERT_NE(mesh.mask, nullptr);
  EXPECT_EQ(mesh.mask->alpha, kAlpha);
  EXPECT_EQ(mesh.mask->cutoff, 0.5F);
  EXPECT_EQ(mesh.mask->wrap, (std::array{MaskWrap::repeat, MaskWrap::repeat}));
  // Its v points up.
  EXPECT_EQ(mesh.mask_places, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0.25F, 0.25F}}));
}

TEST_F(ObjCutout, PositionsWithTwoPlacesStayTwo) {
  set_material("map_d leaf.png\n");
  folder_.write(
      "a.obj",
      "mtllib a.mtl\nusemtl leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 5 5\n"
      "f 1/1 2/2 3/3\nf 1/4 3/3 4/2\n");
  const Mesh mesh = import();
  ASSERT_EQ(mesh.positions.size(), 5U);
  ASSERT_EQ(mesh.mask_places.size(), 5U);
  EXPECT_EQ(mesh.triangles[0].z, mesh.triangles[1].y);
  EXPECT_NE(mesh.triangles[0].x, mesh.triangles[1].x);
  EXPECT_EQ(mesh.mask_places[mesh.triangles[1].x], glm::vec2(5, -4));
  set_material("");
  EXPECT_EQ(import().positions.size(), 4U);
}

TEST_F(ObjCutout, OptionsOfTheMap) {
  set_material("map_d -imfchan m leaf.png\n");
  ASSERT_NE(import().mask, nullptr);
  EXPECT_EQ(import().mask->alpha, kAlpha);
  set_material("map_d -clamp on leaf.png\n");
  EXPECT_EQ(import().mask->wrap, (std::array{MaskWrap::clamp, MaskWrap::clamp}));
}

TEST_F(ObjCutout, DissolveCountsWithAMapAlone) {
  set_material("d 0.8\nmap_d leaf.png\n");
  EXPECT_FLOAT_EQ(import().mask->cutoff, 0.625F);
  set_material("d 0.4\n");
  EXPECT_EQ(import().mask, nullptr);
}

TEST_F(ObjCutout, BrightnessStandsForAlpha) {
  folder_.write("leaf.png", png(2, 2, 1, kAlpha));
  set_material("map_d leaf.png\n");
  EXPECT_EQ(import().mask->alpha, kAlpha);
  folder_.write("leaf.tga", grey_tga(2, 2, kAlpha));
  set_material("map_d leaf.tga\n");
  EXPECT_EQ(import().mask->alpha, kAlpha);
  folder_.write("leaf.jpg", grey_jpeg(40));
  set_material("map_d leaf.jpg\n");
  EXPECT_EQ(import().mask->alpha, Bytes(64, 40));
}

TEST_F(ObjCutout, TheDiffuseMapCutsNothing) {
  set_material("map_Kd leaf.png\n");
  EXPECT_EQ(import().mask, nullptr);
}

TEST_F(ObjCutout, Faults) {
  set_material("map_d none.png\n");
  EXPECT_EQ(folder_.import_fault_of("a.obj"), "a.obj:leaf: none.png: no such file");
  folder_.write("none.png", "none");
  EXPECT_TRUE(folder_.import_fault_of("a.obj").starts_with("a.obj:leaf: image none.png: is not a PNG"));
  set_material("map_d leaf.png\n");
  folder_.write("a.obj", "mtllib a.mtl\nusemtl leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(folder_.import_fault_of("a.obj"), "a.obj:leaf: a mesh has no texture coordinates");
}

}  // namespace
}  // namespace pdsm::test
