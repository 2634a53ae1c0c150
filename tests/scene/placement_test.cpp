// SPDX-License-Identifier: Apache-2.0
// M = T Rz Ry Rx S about fixed axes, counter-clockwise, against numbers worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

class Placement : public testing::Test {
 protected:
  Placement() { folder_.write("box.obj", to_obj(box_mesh({1, 2, 3}))); }

  Geometry box(const std::string& fields) const {
    return folder_.read(scene_of("box.obj", fields)).geometry.at(0);
  }

  /// Where the local point p goes.
  glm::dvec3 image(const std::string& fields, const glm::dvec3& p) const {
    return glm::dvec3(box(fields).local_to_world * glm::dvec4(p, 1.0));
  }

  SceneFolder folder_;
};

TEST_F(Placement, QuarterTurnsAreCounterClockwiseAndExact) {
  EXPECT_EQ(image(R"("rotate": [90, 0, 0])", {0, 1, 0}), glm::dvec3(0, 0, 1));
  EXPECT_EQ(image(R"("rotate": [0, 90, 0])", {0, 0, 1}), glm::dvec3(1, 0, 0));
  EXPECT_EQ(image(R"("rotate": [0, 0, 90])", {1, 0, 0}), glm::dvec3(0, 1, 0));
  EXPECT_EQ(image(R"("rotate": [0, 0, -90])", {1, 0, 0}), glm::dvec3(0, -1, 0));
  EXPECT_EQ(image(R"("rotate": [0, 0, 180])", {1, 2, 0}), glm::dvec3(-1, -2, 0));
  EXPECT_EQ(image(R"("rotate": [0, 0, 630])", {1, 0, 0}), glm::dvec3(0, -1, 0));
}

TEST_F(Placement, ScaleThenXThenYThenZThenTranslate) {
  // (1,1,1) scaled: (2,3,4); about x: (2,-4,3); about y: (3,-4,-2); about z: (4,3,-2); moved: (14,23,28).
  const std::string fields = R"("scale": [2, 3, 4], "rotate": [90, 90, 90], "translate": [10, 20, 30])";
  EXPECT_EQ(image(fields, {1, 1, 1}), glm::dvec3(14, 23, 28));
}

TEST_F(Placement, SlantedTurn) {
  // 30 degrees about x takes (0,1,0) to (0, √3/2, 1/2); 60 about y takes that to (√3/4, √3/2, 1/4).
  const glm::dvec3 p = image(R"("rotate": [30, 60, 0])", {0, 1, 0});
  EXPECT_NEAR(p.x, std::sqrt(3.0) / 4, 1e-15);
  EXPECT_NEAR(p.y, std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(p.z, 0.25, 1e-15);
}

TEST_F(Placement, OneNumberScalesAllAxes) {
  EXPECT_EQ(image(R"("scale": 29.5)", {1, 2, 3}), glm::dvec3(29.5, 59, 88.5));
}

TEST_F(Placement, MirroringKeepsFrontsOutside) {
  for (const char* fields :
       {R"("scale": 2)", R"("scale": [-2, 2, 2])", R"("scale": [2, -2, -2])", R"("scale": -2)"}) {
    const Geometry placed = box(fields);
    EXPECT_NEAR(signed_volume(placed), 48, 1e-12) << fields;
    EXPECT_TRUE(is_closed(*placed.mesh)) << fields;
  }
}

TEST_F(Placement, MirroringOneCopyLeavesTheOther) {
  const Scene scene = folder_.read(
      R"({"geometry": [{"file": "box.obj"}, {"file": "box.obj", "scale": [1, 1, -1]}, {"file": "box.obj"}]})");
  for (const Geometry& geometry : scene.geometry) EXPECT_NEAR(signed_volume(geometry), 6, 1e-12);
}

}  // namespace
}  // namespace pdsm::test
