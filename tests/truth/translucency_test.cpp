// SPDX-License-Identifier: Apache-2.0
// Shadow rays go on behind translucent surfaces, and verify holds bakes of them to that.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "plates.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

Geometry sheet(double x0, double y0, double x1, double y1, double z, double opacity) {
  Geometry geometry = plate(x0, y0, x1, y1, z);
  geometry.opacity = opacity;
  return geometry;
}

TEST(TruthOfTranslucency, LayersMultiplyUpToAnOpaqueOne) {
  Scene scene;
  scene.geometry = {sheet(-40, -40, 40, 40, 3, 0.3), sheet(-40, -40, 40, 40, 5, 0.5),
                    plate(-40, -40, 40, 40, 8), sheet(-40, -40, 40, 40, 9, 0)};
  const ShadowRays rays(scene, light_at_origin(RectLight{2, 2}), 1);
  for (const auto& [z, expected] : {std::pair{2.0, 0.0}, {4.0, 0.3}, {7.0, 0.65}, {10.0, 1.0}})
    EXPECT_NEAR(rays.attenuation({0.3, 0.1, z}, 64, 1), expected, 1e-12) << z;
}

/// The plate's diagonal is in the way of each ray from a point on it to a light that is a point on it.
TEST(TruthOfTranslucency, AnEdgeBetweenTrianglesCountsOnce) {
  Scene scene;
  scene.geometry = {sheet(-4, -4, 4, 4, 5, 0.5)};
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  for (const double at : {-2.0, -1.0, 0.0, 0.5, 3.0})
    EXPECT_EQ(rays.attenuation({at, at, 10}, 4, 1), 0.5) << at;
}

TEST(TruthOfTranslucency, AMaskThatBlendsIsTheOpacity) {
  CutoutMask mask{4, 1, {51, 51, 204, 204}, {MaskWrap::clamp, MaskWrap::clamp}, 0.5F, true};
  Scene scene;
  scene.geometry = {sheet(-4, -4, 4, 4, 5, 0.5)};
  auto mesh = std::make_shared<Mesh>(*scene.geometry[0].mesh);
  mesh->mask = std::make_shared<const CutoutMask>(mask);
  mesh->mask_places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.geometry[0].mesh = mesh;
  const ShadowRays rays(scene, light_at_origin(RectLight{0, 0}), 1);
  EXPECT_NEAR(rays.attenuation({-5, 1, 10}, 4, 1), 0.5 * 0.2, 1e-7);
  EXPECT_NEAR(rays.attenuation({5, 1, 10}, 4, 1), 0.5 * 0.8, 1e-7);
  EXPECT_NEAR(rays.attenuation({0, 1, 10}, 4, 1), 0.5 * 0.5, 1e-7);
}

}  // namespace
}  // namespace pdsm
