// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <xxhash.h>

#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

std::uint64_t hash_of(const std::string& bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

TEST(ContentHash, IsOfTheSceneFileAndAllFilesInOrder) {
  const SceneFolder folder;
  const std::string a = "mtllib b.mtl\n" + to_obj(box_mesh({1, 1, 1})),
                    b = "mtllib b.mtl\n" + to_obj(box_mesh({2, 2, 2}));
  const std::string mtl = "newmtl red\n";
  folder.write("a.obj", a);
  folder.write("b.obj", b);
  folder.write("b.mtl", mtl);
  const std::string scene = R"({"geometry": [{"file": "b.obj"}, {"file": "a.obj"}, {"file": "b.obj"}]})";
  EXPECT_EQ(folder.read(scene).content_hash, hash_of(scene + b + mtl + a));
  EXPECT_EQ(folder.read("{}").content_hash, hash_of("{}"));
}

TEST(ContentHash, ChangesWithEveryFile) {
  const SceneFolder folder;
  folder.write("a.obj", to_obj(box_mesh({1, 1, 1})));
  const std::string scene = scene_of("a.obj");
  const std::uint64_t first = folder.read(scene).content_hash;
  EXPECT_EQ(folder.read(scene).content_hash, first);
  EXPECT_NE(folder.read(scene + " ").content_hash, first);
  folder.write("a.obj", to_obj(box_mesh({1, 1, 1})) + "#\n");
  EXPECT_NE(folder.read(scene).content_hash, first);
}

}  // namespace
}  // namespace pdsm::test
