// SPDX-License-Identifier: Apache-2.0
// What is left out of a scene before a bake does not change the functions: samples that the caller brings
// leave nothing out, and give the same blocks.
#include <gtest/gtest.h>

#include "pdsm/bake/bake.h"
#include "support/random.h"
#include "support/scenes.h"
#include "trace/map_reach.h"

namespace pdsm::test {
namespace {

Scene cluttered_scene() {
  Scene scene;
  Random random(87);
  add(scene, Plate{-40, -40, 40, 40, 9});
  for (int n = 0; n < 300; ++n) {
    const glm::dvec3 low(random.uniform(-12, 12), random.uniform(-12, 12), random.uniform(2, 8));
    add(scene, box_mesh(low, low + glm::dvec3(random.uniform(0.1, 1), random.uniform(0.1, 1), 0.4)));
  }
  return scene;
}

void expect_same_functions(const Light& light, const BakeOptions& options) {
  const Scene scene = cluttered_scene();
  BakeOptions whole = options;
  whole.light_samples = make_light_samples(light, options.samples, options.points, options.seed);
  const BakedMap a = bake(scene, light, options), b = bake(scene, light, whole);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t n = 0; n < a.blocks[0].size(); ++n)
    EXPECT_TRUE(a.blocks[0][n].bytes == b.blocks[0][n].bytes) << "block " << n;
  EXPECT_NE(a.report.key, b.report.key) << "something must have been left out";
}

BakeOptions various_options() {
  BakeOptions options;
  options.samples = 24;
  options.width = 100;
  options.height = 70;
  options.map_width = 200;
  options.map_height = 35;
  return options;
}

TEST(SeenPart, IsAllThatDarkens) {
  Light rect = rect_light(2, 1), disk = disk_light(0.7), sun = distant_light(5);
  rect.window = {-0.6, -0.4, 0.3, 0.4};
  disk.window = {-0.3, -0.3, 0.9, 0.3};
  sun.window = {-4, -3, 4, 5};
  for (const Light& light : {rect, disk, sun}) {
    for (const Walk walk : {Walk::exact, Walk::midpoint}) {
      BakeOptions options = various_options();
      options.walk = walk;
      expect_same_functions(light, options);
    }
    BakeOptions surfaces = various_options();
    surfaces.receivers = Receivers::surfaces;
    expect_same_functions(light, surfaces);
  }
}

TEST(SeenPart, KeepsOrderAndDropsWhatIsUnused) {
  LightSpaceScene scene;
  LightSpaceMesh mesh;
  for (const float x : {-5.0F, 0.0F, 5.0F}) {
    for (const float y : {0.0F, 1.0F}) mesh.positions.push_back({x, y, 4});
  }
  mesh.triangles = {{4, 5, 5}, {0, 1, 0}, {2, 3, 4}, {2, 2, 3}};
  mesh.receives = false;
  scene.meshes = {mesh, mesh};
  scene.meshes[1].triangles = {{0, 1, 1}};
  ConvexRegion region;
  region.add({{1, 0, 0}, 1});   // x >= -1
  region.add({{-1, 0, 0}, 1});  // x <= 1
  keep_within(scene, region);
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.triangles, 2U);
  const LightSpaceMesh& left = scene.meshes[0];
  EXPECT_FALSE(left.receives);
  EXPECT_EQ(left.positions, (std::vector<glm::vec3>{{0, 0, 4}, {0, 1, 4}, {5, 0, 4}}));
  EXPECT_EQ(left.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 0, 1}}));
}

}  // namespace
}  // namespace pdsm::test
