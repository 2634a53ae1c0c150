// SPDX-License-Identifier: Apache-2.0
// A baked map of six views on the GPU.
#include <gtest/gtest.h>

#include "gpu_look_up.h"
#include "pdsm/bake/bake.h"

namespace pdsm {
namespace {

using testing::EglContext;
using testing::FloatPoint;
using testing::GlApi;

/// A square of edge 1 at height `y`.
Geometry plate(float x, float y, float z) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{x, y, z}, {x + 1, y, z}, {x + 1, y, z + 1}, {x, y, z + 1}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  Geometry geometry;
  geometry.name = "plate";
  geometry.mesh = std::move(mesh);
  return geometry;
}

PenumbraMap bake_bulb() {
  Scene scene;
  for (const auto& [x, y, z] : {std::array{0.2F, 1.0F, -0.3F},
                                {-0.5F, -1.0F, 0.4F},
                                {1.0F, 0.4F, -0.4F},
                                {-2.0F, 0.6F, 0.2F},
                                {-0.4F, 0.5F, -1.9F},
                                {-0.7F, -0.4F, 1.1F}})
    scene.geometry.push_back(plate(x, y, z));
  Light light;
  light.name = "bulb";
  light.shape = SphereLight{0.2};
  light.far_depth = 4;
  BakeOptions options;
  options.samples = 16;
  options.width = options.height = 48;
  options.receivers = Receivers::all;
  return decode_blocks(bake(scene, light, options));
}

TEST(SeveralViews, TheGpuAgreesWithTheCpuAroundABulb) {
  const PenumbraMap map = bake_bulb();
  ASSERT_EQ(map.views.size(), 6U);
  const PenumbraLookUp look_up(map);
  testing::Random random(3);
  std::vector<FloatPoint> points = testing::points_to_try(random, map, 3000);
  const auto coordinate = [&random] { return static_cast<float>(random.below(8192)) / 1024 - 4; };
  for (int n = 0; n < 3000; ++n) points.push_back({coordinate(), coordinate(), coordinate()});
  std::size_t dark = 0;
  for (const FloatPoint& p : points)
    dark += look_up.at({p[0], p[1], p[2]}, Filter::bilinear).attenuation > 0 ? 1 : 0;
  EXPECT_GT(dark, 300U);
  const PenumbraMap* const maps[] = {&map};
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  for (const TextureLayout layout : {TextureLayout::two_level, TextureLayout::fixed_depth}) {
    shadows.upload(maps, layout);
    shadows.set_look_up(0, {Filter::bilinear, 0});
    const std::vector<float> values = testing::gpu_look_up(shadows, GlApi::core_33, 0, points);
    for (std::size_t n = 0; n < points.size(); ++n)
      ASSERT_TRUE(testing::may_say(values[n], map, look_up, points[n], Filter::bilinear))
          << points[n][0] << ' ' << points[n][1] << ' ' << points[n][2];
  }
}

}  // namespace
}  // namespace pdsm
