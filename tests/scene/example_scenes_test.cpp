// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "pdsm/bake/view_fit.h"
#include "scene_folder.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

std::string example(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(PDSM_EXAMPLES_DIR "/" + name).rdbuf();
  return text.str();
}

TEST(ExampleScenes, PlateIsAsDescribed) {
  const Scene scene = read_scene(PDSM_EXAMPLES_DIR "/plate.scene.json");
  ASSERT_EQ(scene.geometry.size(), 2U);
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_TRUE(scene.warnings.empty());
  const Light& key = scene.lights[0];
  EXPECT_EQ(half_extents(key), (std::array<double, 2>{1, 0.5}));
  EXPECT_EQ(key.samples, 1024U);
  const FittedView fitted = fit_view(scene, key, 512, 512);
  EXPECT_NEAR(fitted.view.near_depth, 3.5, 1e-5);
  EXPECT_NEAR(fitted.view.far_depth, 6, 1e-5);
  // The plate's corners in light space: x 0.2 ± 0.6, y -0.1 ± 0.4, depth 3.5.
  const glm::dvec3 corner = glm::dvec3(scene.geometry[0].local_to_world *
                                       glm::dvec4(glm::dvec3(scene.geometry[0].mesh->positions[0]), 1.0));
  EXPECT_LT(glm::length(apply(fitted.view.world_to_view, corner) - glm::dvec3(-0.4, -0.5, 3.5)), 1e-7);
}

TEST(ExampleScenes, DragonSceneReadsWithAnyDragon) {
  const SceneFolder folder;
  folder.write("ground.obj", example("ground.obj"));
  folder.write("dragon.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0.06 0\n0.1 0.1 0\n0 0.1 0.1\n3 0 1 2\n");
  const Scene scene = folder.read(example("dragon.scene.json"));
  ASSERT_EQ(scene.geometry.size(), 2U);
  EXPECT_EQ(scene.geometry[0].local_to_world[0][0], 29.2);
  const FittedView fitted = fit_view(scene, scene.lights.at(0), 512, 512);
  EXPECT_NEAR(fitted.view.window[2], 0.35, 1e-5);
  EXPECT_NEAR(fitted.view.far_depth, 12, 1e-4);
}

TEST(ExampleScenes, CourtyardReadsWithoutItsGeometry) {
  const SceneFolder folder;
  for (const char* part : {"floor", "solid", "thin", "knot"}) {
    folder.write(std::string("courtyard_") + part + ".obj", to_obj(box_mesh({1, 1, 1})));
  }
  const Scene scene = folder.read(example("courtyard.scene.json"));
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].name, "key");
  EXPECT_TRUE(std::holds_alternative<RectLight>(scene.lights[0].shape));
  EXPECT_EQ(scene.lights[1].name, "lamp");
  EXPECT_TRUE(std::holds_alternative<DiskLight>(scene.lights[1].shape));
}

}  // namespace
}  // namespace pdsm::test
