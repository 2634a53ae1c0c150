// SPDX-License-Identifier: Apache-2.0
// One tetrahedron in many formats, packed and not.
#include <gtest/gtest.h>
#include <zlib.h>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

const char* const kObj =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 0\nvt 1 1\nusemtl red\n"
    "f 1/1/1 3/2/1 2/1/1\nf 1/1/1 2/1/1 4/2/1\nf 1/1/1 4/1/1 3/2/1\nf 2/2/1 3/1/1 4/1/1\n";
const char* const kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string stl() {
  const char* const facets[4][3] = {{"0 0 0", "0 1 0", "1 0 0"},
                                    {"0 0 0", "1 0 0", "0 0 1"},
                                    {"0 0 0", "0 0 1", "0 1 0"},
                                    {"1 0 0", "0 1 0", "0 0 1"}};
  std::string text = "solid tetrahedron\n";
  for (const auto& facet : facets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const char* corner : facet) text += std::string("vertex ") + corner + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

std::string gzip(const std::string& bytes) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16, 9, Z_DEFAULT_STRATEGY),
            Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()) + 32, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

class GeometryFormats : public testing::Test {
 protected:
  void expect_tetrahedron(const std::string& name) const {
    SCOPED_TRACE(name);
    const std::vector<Geometry> parts = import_geometry(folder_.path() / name);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].mesh->positions.size(), 4U);
    EXPECT_EQ(parts[0].mesh->triangles.size(), 4U);
    EXPECT_TRUE(parts[0].mesh->closed);
    EXPECT_NEAR(signed_volume(parts[0]), 1.0 / 6, 1e-12);
  }

  SceneFolder folder_;
};

TEST_F(GeometryFormats, ObjPlyAndStlReadAlike) {
  folder_.write("a.obj", kObj);
  folder_.write("a.ply", kPly);
  folder_.write("a.stl", stl());
  folder_.write("A.STL", stl());
  for (const char* name : {"a.obj", "a.ply", "a.stl", "A.STL"}) expect_tetrahedron(name);
}

TEST_F(GeometryFormats, PackedFilesReadAsUnpacked) {
  folder_.write("a.obj.gz", gzip(kObj));
  folder_.write("a.ply.gz", gzip(kPly));
  folder_.write("B.STL.GZ", gzip(stl()));
  // gzip files may follow each other in one.
  folder_.write("two.ply.gz", gzip(std::string(kPly).substr(0, 100)) + gzip(std::string(kPly).substr(100)));
  for (const char* name : {"a.obj.gz", "a.ply.gz", "B.STL.GZ", "two.ply.gz"}) expect_tetrahedron(name);
}

TEST_F(GeometryFormats, PackedLargeFileIsUnpackedWhole) {
  // Unpacks to 300 times its size, so that the guess of the unpacked size is far too small.
  std::string ply = kPly;
  ply.insert(ply.find("element vertex"), [] {
    std::string comments;
    for (int i = 0; i < 20000; ++i) comments += "comment the same again and again\n";
    return comments;
  }());
  folder_.write("a.ply.gz", gzip(ply));
  expect_tetrahedron("a.ply.gz");
}

TEST_F(GeometryFormats, BrokenPackedFilesAreRefused) {
  const std::string packed = gzip(kPly);
  for (std::size_t size = 0; size < packed.size(); ++size) {
    folder_.write("cut.ply.gz", packed.substr(0, size));
    EXPECT_EQ(folder_.import_fault_of("cut.ply.gz"), "cut.ply.gz: gzip data is cut short") << size;
  }
  folder_.write("plain.ply.gz", kPly);
  EXPECT_EQ(folder_.import_fault_of("plain.ply.gz"), "plain.ply.gz: is not valid gzip data");
  folder_.write("tail.ply.gz", packed + "tail");
  EXPECT_EQ(folder_.import_fault_of("tail.ply.gz"), "tail.ply.gz: is not valid gzip data");
}

TEST_F(GeometryFormats, MaterialGivesTheBaseColor) {
  folder_.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(import_geometry(folder_.path() / "plain.obj").at(0).base_color, Geometry{}.base_color);
  folder_.write("a.obj", kObj);
  folder_.write("a.mtl", "newmtl red\nKd 0.75 0.25 0.125\n");
  EXPECT_EQ(import_geometry(folder_.path() / "a.obj").at(0).base_color, glm::vec3(0.75F, 0.25F, 0.125F));
}

TEST_F(GeometryFormats, PolygonsAreTriangulated) {
  // A concave pentagon, an arrowhead of area 1: a fan from its first corner would be wrong.
  folder_.write("a.obj", "v 0 0 0\nv 1 -1 0\nv 1 0 0\nv 1 1 0\nv 0.5 0.25 0\nf 2 3 4 5 1\n");
  const std::vector<Geometry> parts = import_geometry(folder_.path() / "a.obj");
  ASSERT_EQ(parts.size(), 1U);
  double area = 0;
  for (const glm::uvec3& t : parts[0].mesh->triangles) {
    const auto& p = parts[0].mesh->positions;
    const double own = glm::cross(glm::dvec3(p[t.y] - p[t.x]), glm::dvec3(p[t.z] - p[t.x])).z / 2;
    EXPECT_GT(own, 0);
    area += own;
  }
  // Shoelace: 1/2 |sum x_i y_i+1 - x_i+1 y_i| over (1,-1) (1,0) (1,1) (0.5,0.25) (0,0).
  EXPECT_NEAR(area, 0.5 * (1 + 1 + (0.25 - 0.5)), 1e-7);
}

TEST_F(GeometryFormats, SeveralObjectsAreSeveralParts) {
  folder_.write("a.obj",
                "o floor\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no lid\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 4 5 6\n");
  const std::vector<Geometry> parts = import_geometry(folder_.path() / "a.obj");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "a.obj:floor");
  EXPECT_EQ(parts[1].name, "a.obj:lid");
}

}  // namespace
}  // namespace pdsm::test
