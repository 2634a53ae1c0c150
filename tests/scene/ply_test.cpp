// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

const std::string kHead = "ply\nformat ascii 1.0\n";
const std::string kVertex = "property float x\nproperty float y\nproperty float z\n";
const std::string kFace = "property list uchar int vertex_indices\n";

/// A unit tetrahedron, fronts outwards.
const std::array<std::array<float, 3>, 4> kCorners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const std::array<std::array<std::int32_t, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
const std::string kAscii = kHead + "element vertex 4\n" + kVertex + "element face 4\n" + kFace +
                           "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

template <typename T>
std::string raw(T value, bool big) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return {bytes.begin(), bytes.end()};
}

/// The tetrahedron in binary, among properties and elements that are of no use here.
std::string binary(bool big) {
  std::string bytes =
      std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\r\ncomment element face 7\r\nobj_info none\r\nelement vertex 4\r\n"
      "property uchar red\r\nproperty double x\r\nproperty float y\r\nproperty short z\r\n"
      "property list ushort float weights\r\nelement camera 1\r\nproperty list int short nothing\r\n"
      "element face 4\r\nproperty int group\r\nproperty list uint uint vertex_index\r\nend_header\r\n";
  for (const auto& p : kCorners) {
    bytes += '\7' + raw(static_cast<double>(p[0]), big) + raw(p[1], big) +
             raw(static_cast<std::int16_t>(p[2]), big);
    bytes += raw(std::uint16_t{2}, big) + raw(0.5F, big) + raw(0.5F, big);
  }
  bytes += raw(std::int32_t{1}, big) + raw(std::int16_t{9}, big);
  for (const auto& f : kFaces) {
    bytes += raw(std::int32_t{0}, big) + raw(std::uint32_t{3}, big);
    for (const std::int32_t i : f) bytes += raw(i, big);
  }
  return bytes;
}

class PlyTest : public testing::Test {
 protected:
  std::vector<Geometry> import(const std::string& bytes) const {
    return import_geometry(folder_.write("a.ply", bytes));
  }
  std::string fault(const std::string& bytes) const {
    folder_.write("a.ply", bytes);
    return folder_.import_fault_of("a.ply");
  }

  SceneFolder folder_;
};

TEST_F(PlyTest, AsciiAndBothBinariesReadAlike) {
  for (const std::string& bytes : {kAscii, binary(false), binary(true)}) {
    const std::vector<Geometry> parts = import(bytes);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].name, "a.ply");
    EXPECT_TRUE(parts[0].mesh->closed);
    EXPECT_NEAR(signed_volume(parts[0]), 1.0 / 6, 1e-12);
  }
}

TEST_F(PlyTest, NumbersInEveryNotation) {
  const std::string ply = kHead + "element vertex 3\n" + kVertex + "element face 1\n" + kFace +
                          "end_header\n\r\n+0.5\t-1e-2 1E2\r\n 1e-999 .25 0 \n\n3\n4\n5\n3 0 1\n2";
  const std::vector<glm::vec3> positions = import(ply).at(0).mesh->positions;
  ASSERT_EQ(positions.size(), 3U);
  EXPECT_EQ(positions[0], glm::vec3(0.5F, -0.01F, 100));
  EXPECT_EQ(positions[1], glm::vec3(0, 0.25F, 0));
  EXPECT_EQ(positions[2], glm::vec3(3, 4, 5));
}

TEST_F(PlyTest, FacesMayComeFirst) {
  EXPECT_EQ(import(kHead + "element face 1\n" + kFace + "element vertex 3\n" + kVertex +
                   "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n")
                .at(0)
                .mesh->triangles.size(),
            1U);
}

TEST_F(PlyTest, PolygonsKeepShapeAndWinding) {
  // In turn about all axes: an arrowhead of area 2, whose first corner is the wrong one to fan out from.
  for (int axis = 0; axis < 3; ++axis) {
    std::string body;
    const double flat[4][2] = {{4, -2}, {1, 0}, {4, 2}, {0, 0}};
    for (const auto& p : flat) {
      double xyz[3] = {0, 0, 0};
      xyz[(axis + 1) % 3] = p[0];
      xyz[(axis + 2) % 3] = p[1];
      for (const double v : xyz) body += fmt::format("{} ", v);
    }
    for (const bool back : {false, true}) {
      const auto mesh = import(kHead + "element vertex 4\n" + kVertex + "element face 1\n" + kFace +
                               "end_header\n" + body + (back ? "\n4 3 2 1 0\n" : "\n4 0 1 2 3\n"))
                            .at(0)
                            .mesh;
      ASSERT_EQ(mesh->triangles.size(), 2U);
      double total = 0;
      for (const glm::uvec3& t : mesh->triangles) {
        const auto& p = mesh->positions;
        const double own = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x])[axis] / 2;
        EXPECT_GT(back ? -own : own, 0) << axis;
        total += own;
      }
      EXPECT_NEAR(total, back ? -2 : 2, 1e-6) << axis;
    }
  }
}

TEST_F(PlyTest, PolygonOfManyCornersIsCoveredOnce) {
  // A star: every second corner lies inwards. Its area is the sum of the triangles from its centre.
  const int corners = 14;
  std::string body, face = std::to_string(corners);
  double expected = 0;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = i % 2 == 0 ? 1 : 0.25;
    body += fmt::format("{} {} 0\n", radius * std::cos(angle), radius * std::sin(angle));
    face += fmt::format(" {}", i);
    expected += 0.25 * std::sin(2 * std::numbers::pi / corners) / 2;
  }
  const auto mesh = import(kHead + "element vertex 14\n" + kVertex + "element face 1\n" + kFace +
                           "end_header\n" + body + face + "\n")
                        .at(0)
                        .mesh;
  ASSERT_EQ(mesh->triangles.size(), 12U);
  double total = 0;
  for (const glm::uvec3& t : mesh->triangles) {
    const auto& p = mesh->positions;
    const double own = glm::cross(glm::dvec3(p[t.y] - p[t.x]), glm::dvec3(p[t.z] - p[t.x])).z / 2;
    EXPECT_GT(own, 0);
    total += own;
  }
  EXPECT_NEAR(total, expected, 1e-5);
}

TEST_F(PlyTest, LastNumberNeedsNoSpaceBehindIt) {
  EXPECT_EQ(fault(kHead + "element value 2\nproperty int a\nend_header\n1 2"), "");
}

TEST_F(PlyTest, EveryPrefixIsRefusedOrShort) {
  for (const std::string& bytes : {kAscii, binary(false), binary(true)}) {
    for (std::size_t size = 0; size < bytes.size() - 1; ++size) {
      const std::string told = fault(bytes.substr(0, size));
      EXPECT_EQ(told.substr(0, 7), "a.ply: ") << size;
    }
  }
}

TEST_F(PlyTest, AnyFlippedBitIsReadOrRefused) {
  // What matters is that it ends, without a sanitizer's report.
  int read = 0, refused = 0;
  for (const std::string& original : {kAscii, binary(false)}) {
    for (std::size_t bit = 0; bit < original.size() * 8; bit += 3) {
      std::string bytes = original;
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
      ++(fault(bytes).empty() ? read : refused);
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

TEST_F(PlyTest, FaultsSayWhere) {
  const std::string vertices = kHead + "element vertex 2\n" + kVertex;
  EXPECT_EQ(fault(vertices + "end_header\n0 0 0\n0 zero 0\n"), "a.ply: vertex 1: not a number");
  EXPECT_EQ(fault(vertices + "end_header\n0 0 0\n0 0 1.5.2\n"), "a.ply: vertex 1: not a number");
  EXPECT_EQ(fault(vertices + "end_header\n0 0 0\n          0"), "a.ply: vertex 1: the file ends");
  EXPECT_EQ(fault(vertices + "end_header\n0 0 0"), "a.ply: ends before its 2 rows of vertex");
  EXPECT_EQ(fault(vertices + "element face 1\n" + kFace + "end_header\n0 0 0\n0 0 0\n200 0 1 2"),
            "a.ply: face 0: a list longer than the file");
  EXPECT_EQ(fault(kHead + "element vertex 99999999999999\n" + kVertex + "end_header\n0 0 0\n"),
            "a.ply: ends before its 99999999999999 rows of vertex");
  EXPECT_EQ(fault(kHead + "element vertex many\n"), "a.ply: line 3: must be: element NAME COUNT");
  EXPECT_EQ(fault(kHead + "element vertex 1\nproperty half x\n"), "a.ply: line 4: unknown type half");
  EXPECT_EQ(fault(kHead + "property float x\n"), "a.ply: line 3: a property before any element");
  EXPECT_EQ(fault(kHead + "vertices 3\n"), "a.ply: line 3: unknown keyword vertices");
  EXPECT_EQ(fault("ply\nformat text 1.0\n"), "a.ply: line 2: unknown format");
  EXPECT_EQ(fault("ply\nend_header\n"), "a.ply: line 2: the header names no format");
  EXPECT_EQ(fault("solid\n"), "a.ply: line 1: must be \"ply\"");
  EXPECT_EQ(fault(kHead + "element vertex"), "a.ply: line 3: the header does not end");
}

TEST_F(PlyTest, RowsOfNothingTakeNoTime) {
  EXPECT_EQ(fault(kHead + "element nothing 18446744073709551615\nend_header\n"), "");
}

}  // namespace
}  // namespace pdsm::test
