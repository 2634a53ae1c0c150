// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "test_meshes.h"

namespace pdsm {
namespace {

/// The same triangles, each with positions of its own.
Mesh unwelded(const Mesh& mesh) {
  Mesh result;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (int i = 0; i < 3; ++i) result.positions.push_back(mesh.positions[t[i]]);
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

/// Both meshes in one.
Mesh joined(Mesh a, const Mesh& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
  return a;
}

Mesh moved(Mesh mesh, const glm::vec3& by) {
  for (glm::vec3& p : mesh.positions) p += by;
  return mesh;
}

TEST(IsClosed, BoxIsClosedIndexedOrNot) {
  const Mesh box = test::box_mesh({1, 2, 3});
  EXPECT_TRUE(is_closed(box));
  EXPECT_TRUE(is_closed(unwelded(box)));
}

TEST(IsClosed, InsideOutIsClosedToo) {
  Mesh box = test::box_mesh({1, 2, 3});
  for (glm::uvec3& t : box.triangles) std::swap(t.y, t.z);
  EXPECT_TRUE(is_closed(box));
}

TEST(IsClosed, MissingTriangleOpens) {
  for (std::size_t i = 0; i < 12; ++i) {
    Mesh box = test::box_mesh({1, 2, 3});
    box.triangles.erase(box.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(is_closed(box)) << i;
  }
}

TEST(IsClosed, TriangleOfOtherWindingOpens) {
  for (std::size_t i = 0; i < 12; ++i) {
    Mesh box = test::box_mesh({1, 2, 3});
    std::swap(box.triangles[i].y, box.triangles[i].z);
    EXPECT_FALSE(is_closed(box)) << i;
  }
}

TEST(IsClosed, EdgeOfFourTrianglesOpens) {
  // Two boxes that touch along one edge: positions weld, and four triangles meet there.
  const Mesh box = test::box_mesh({1, 1, 1});
  EXPECT_TRUE(is_closed(joined(box, moved(box, {3, 3, 0}))));
  EXPECT_FALSE(is_closed(joined(box, moved(box, {1, 1, 0}))));
  // At one corner they may touch.
  EXPECT_TRUE(is_closed(joined(box, moved(box, {1, 1, 1}))));
}

TEST(IsClosed, NegativeZeroIsZero) {
  Mesh box = unwelded(test::box_mesh({2, 2, 2}));
  for (glm::vec3& p : box.positions) p += 1.0F;
  int turn = 0;
  for (glm::vec3& p : box.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] == 0 && ++turn % 2 == 0) p[axis] = -0.0F;
    }
  }
  EXPECT_TRUE(is_closed(box));
}

TEST(IsClosed, CollapsedTrianglesDoNotCount) {
  Mesh box = test::box_mesh({1, 1, 1});
  box.triangles.emplace_back(0U, 0U, 1U);
  box.triangles.emplace_back(5U, 5U, 5U);
  EXPECT_TRUE(is_closed(box));
}

TEST(IsClosed, OpenEmptyAndBrokenMeshesAreNot) {
  EXPECT_FALSE(is_closed(test::plate_mesh(1, 1)));
  EXPECT_FALSE(is_closed(Mesh{}));
  Mesh box = test::box_mesh({1, 1, 1});
  box.triangles[3].y = 8;
  EXPECT_FALSE(is_closed(box));
}

}  // namespace
}  // namespace pdsm
