// SPDX-License-Identifier: Apache-2.0
#include "trace/traced_mesh.h"

#include <gtest/gtest.h>

namespace pdsm::test {
namespace {

TEST(TracedMeshes, ShareTheCellsOfTheMasksThatTheyShare) {
  const auto mask = std::make_shared<const CutoutMask>(CutoutMask{2, 2, {255, 0, 255, 0}, {}, 0.5F});
  LightSpaceMesh leaf;
  leaf.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  leaf.triangles = {{0, 1, 2}};
  leaf.mask = mask;
  leaf.mask_places = {{0, 0}, {1, 0}, {0, 1}};
  LightSpaceMesh receiver = leaf, plate = leaf;
  receiver.casts = false;
  plate.mask = nullptr;
  const LightSpaceScene scene{{leaf, plate, leaf, receiver}, {}, {}, 4, 0};
  const std::vector<TracedMesh> traced = traced_meshes(scene);
  ASSERT_EQ(traced.size(), 4U);
  EXPECT_NE(traced[0].cells, nullptr);
  EXPECT_EQ(traced[0].cells, traced[2].cells);
  EXPECT_EQ(traced[0].triangles.size(), 1U);
  for (const std::size_t without : {1U, 3U}) {
    EXPECT_EQ(traced[without].cells, nullptr);
    EXPECT_TRUE(traced[without].triangles.empty());
  }
}

}  // namespace
}  // namespace pdsm::test
