// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

class LightInside : public testing::Test {
 protected:
  LightInside() {
    Mesh mesh = box_mesh({2, 2, 2});
    folder_.write("box.obj", to_obj(mesh));
    Mesh room = mesh;
    for (glm::uvec3& t : room.triangles) std::swap(t.y, t.z);
    folder_.write("room.obj", to_obj(room));
    mesh.triangles.pop_back();
    folder_.write("open.obj", to_obj(mesh));
  }

  std::vector<std::string> warnings(const std::string& file, const std::string& position,
                                    const std::string& fields = "") const {
    return folder_
        .read(
            R"({"geometry": [{"file": ")" + file + "\"" + fields +
            R"(}], "lights": [{"name": "key", "type": "disk", "radius": 0.1, "direction": [0, -1, 0], "position": )" +
            position + "}]}")
        .warnings;
  }

  SceneFolder folder_;
};

TEST_F(LightInside, OfASolidIsWarnedOf) {
  const std::vector<std::string> told{"key: the light lies inside box.obj"};
  EXPECT_EQ(warnings("box.obj", "[0.9, -0.9, 0.9]"), told);
  EXPECT_EQ(warnings("box.obj", "[100000.5, 0, 0]", R"(, "translate": [100000, 0, 0])"), told);
  EXPECT_EQ(warnings("box.obj", "[0.5, 0, 0]", R"(, "scale": [-1, 1, 1])"), told);
}

TEST_F(LightInside, OfAnythingElseIsNot) {
  const std::vector<std::string> none;
  EXPECT_EQ(warnings("box.obj", "[1.1, 0, 0]"), none);
  EXPECT_EQ(warnings("box.obj", "[0, 0, 0]", R"(, "casts": false)"), none);
  EXPECT_EQ(warnings("room.obj", "[0, 0, 0]"), none);
  EXPECT_EQ(warnings("open.obj", "[0, 0, 0]"), none);
}

}  // namespace
}  // namespace pdsm::test
