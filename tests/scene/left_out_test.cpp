// SPDX-License-Identifier: Apache-2.0
// Triangles that cannot be traced are left out and counted, one warning a file.
#include <gtest/gtest.h>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

std::string ply_of(const std::string& vertices, int vertex_count, const std::string& faces, int face_count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices +
         faces;
}

class LeftOutTest : public testing::Test {
 protected:
  Scene read(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
    return folder_.read(scene_of(name));
  }

  SceneFolder folder_;
};

using Warnings = std::vector<std::string>;

TEST_F(LeftOutTest, NotFiniteOrHugeCoordinates) {
  const Scene scene = read("a.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e308 0 0\nv nan 0 0\nv 0 -1e20 0\n"
                           "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\n");
  EXPECT_EQ(scene.warnings, Warnings{"a.obj: 3 triangles with NaN or infinite coordinates left out"});
  ASSERT_EQ(scene.geometry.size(), 1U);
  EXPECT_EQ(scene.geometry[0].mesh->triangles.size(), 1U);
  EXPECT_EQ(scene.geometry[0].mesh->positions.size(), 3U);
}

TEST_F(LeftOutTest, TrianglesWithoutArea) {
  const Scene scene = read("a.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 0\n"
                           "f 1 2 3\nf 1 2 4\nf 1 5 3\n");
  EXPECT_EQ(scene.warnings, Warnings{"a.obj: 2 triangles without area left out"});
  EXPECT_EQ(scene.geometry.at(0).mesh->triangles.size(), 1U);
}

TEST_F(LeftOutTest, IndicesOutOfRange) {
  // One triangle, and one quadrilateral, which would be two.
  const Scene scene =
      read("a.ply", ply_of("0 0 0\n1 0 0\n1 1 0\n0 1 0\n", 4, "4 0 1 2 3\n3 0 1 4\n4 0 1 2 99999999\n", 3));
  EXPECT_EQ(scene.warnings, Warnings{"a.ply: 3 triangles with corners out of range left out"});
  EXPECT_EQ(scene.geometry.at(0).mesh->triangles.size(), 2U);
}

TEST_F(LeftOutTest, ObjWithIndicesOutOfRangeIsRefused) {
  folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  EXPECT_EQ(folder_.fault_of(scene_of("a.obj")),
            "level.scene.json:geometry[0].file: a.obj: OBJ: vertex index out of range");
}

TEST_F(LeftOutTest, ReasonsShareOneWarning) {
  const Scene scene =
      read("a.ply", ply_of("0 0 0\n1 0 0\n1 1 0\nnan 1 0\n", 4, "3 0 1 9\n3 0 1 3\n3 0 1 1\n", 3));
  EXPECT_EQ(scene.warnings, Warnings{"a.ply: 1 triangle with corners out of range, 1 with NaN or infinite "
                                     "coordinates, 1 without area left out"});
  EXPECT_TRUE(scene.geometry.empty());
}

TEST_F(LeftOutTest, FileUsedTwiceIsWarnedOfOnce) {
  folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n");
  EXPECT_EQ(folder_.read(R"({"geometry": [{"file": "a.obj"}, {"file": "a.obj"}]})").warnings.size(), 1U);
}

TEST_F(LeftOutTest, SliverThatJoinsItsNeighboursLeavesTheMeshClosed) {
  // A box one of whose edges is split on one side only; a triangle without area fills the gap.
  Mesh box = box_mesh({2, 2, 2});
  box.positions.emplace_back(0.0F, -1.0F, -1.0F);  // amid edge 0-1
  box.triangles[8] = {0, 2, 8};                    // of 0-2-3, 0-3-1
  box.triangles[9] = {8, 2, 3};
  box.triangles.emplace_back(8U, 3U, 1U);
  box.triangles.emplace_back(0U, 8U, 1U);
  ASSERT_TRUE(is_closed(box));
  const Scene scene = read("a.obj", to_obj(box));
  EXPECT_EQ(scene.warnings, Warnings{"a.obj: 1 triangle without area left out"});
  EXPECT_TRUE(scene.geometry.at(0).mesh->closed);
}

TEST_F(LeftOutTest, FilesWithoutTrianglesAreValid) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_TRUE(read("points.obj", vertices).geometry.empty());
  const Scene lines = read("lines.obj", vertices + "l 1 2\np 3\n");
  EXPECT_TRUE(lines.geometry.empty());
  EXPECT_TRUE(lines.warnings.empty());
  EXPECT_TRUE(read("none.ply", ply_of("0 0 0\n1 0 0\n1 1 0\n", 3, "", 0)).geometry.empty());
  EXPECT_TRUE(read("none.stl", "solid a\nendsolid a\n").geometry.empty());
  EXPECT_TRUE(read("none.gltf", R"({"asset": {"version": "2.0"}})").geometry.empty());
}

TEST_F(LeftOutTest, NodesAndMaterialsAreNamed) {
  const auto object = [](const std::string& name, const std::string& material, bool good) {
    return "o " + name + "\n" + (material.empty() ? "" : "usemtl " + material + "\n") + "f 1 2 3\n" +
           (good ? "" : "f 1 1 3\n");
  };
  folder_.write("a.mtl", "newmtl brick\nKd 1 0 0\nnewmtl tiles\nKd 0 1 0\n");
  const std::string begin = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string one = begin + object("wall", "brick", false) + object("floor", "brick", true);
  EXPECT_EQ(read("a.obj", one).warnings,
            Warnings{"a.obj: 1 triangle without area left out, of wall (brick)"});
  const std::string two = one + object("roof", "tiles", false);
  EXPECT_EQ(read("b.obj", two).warnings,
            Warnings{"b.obj: 2 triangles without area left out, of wall (brick) and roof (tiles)"});
  const std::string five =
      two + object("a", "tiles", false) + object("b", "tiles", false) + object("c", "tiles", false);
  EXPECT_EQ(
      read("c.obj", five).warnings,
      Warnings{
          "c.obj: 5 triangles without area left out, of wall (brick), roof (tiles), a (tiles) and 2 more"});
}

}  // namespace
}  // namespace pdsm::test
