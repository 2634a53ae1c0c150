// SPDX-License-Identifier: Apache-2.0
// Planar lights that shine to both sides.
#include <gtest/gtest.h>

#include "light/light_faces.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/look_up.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/exact_truth.h"

namespace pdsm::test {
namespace {

/// Plates before both sides of a light, and where each side's light ends.
constexpr Plate kFront{0.2, -0.5, 1, 0.6, 3}, kBack{-0.9, -0.4, 0.1, 0.5, -2.5};

Scene between_plates() {
  Scene scene;
  for (const Plate& plate : {kFront, kBack}) add(scene, plate);
  for (const double z : {6.0, -5.0}) add(scene, Plate{-kWide, -kWide, kWide, kWide, z});
  return scene;
}

Light two_sided_light(std::uint32_t faces) {
  Light light = rect_light(0.8, 0.6);
  light.two_sided = true;
  light.faces = faces;
  return light;
}

/// A plate as the light's other side sees it.
Plate from_behind(const Plate& p) {
  return {-p.x1, p.y0, -p.x0, p.y1, -p.z};
}

/// Of all views, in tangents.
double largest_pitch(const PenumbraMap& map) {
  double pitch = 0;
  for (const View& view : map.views)
    pitch = std::max({pitch, (view.window[2] - view.window[0]) / view.width,
                      (view.window[3] - view.window[1]) / view.height});
  return pitch;
}

double truth_at(const glm::dvec3& p) {
  if (p.z > 0) return rect_plate(0.8, 0.6, kFront, p.x, p.y, p.z);
  return rect_plate(0.8, 0.6, from_behind(kBack), -p.x, p.y, -p.z);
}

TEST(TwoSided, BothSidesAreDarkenedByWhatIsBeforeThem) {
  constexpr std::uint32_t kSamples = 144;
  for (const std::uint32_t faces : {1U, 6U}) {
    BakeOptions options = small_options(128, 128, kSamples);
    options.epsilon = 0.005;
    const BakedFunctions baked(between_plates(), two_sided_light(faces), options);
    ASSERT_EQ(baked.map().views.size(), faces == 1 ? 2U : 6U);
    const PenumbraLookUp look_up(baked.map());
    int penumbra = 0;
    for (int n = 0; n < 400; ++n) {
      const double share = n / 400.0, side = n % 2 == 0 ? 5.2 : -4.4;
      const glm::dvec3 p(3 * share - 1.5, 0.7 * std::sin(7.0 * n), side);
      // A texel of the quad around it, and what a map texel on the plate is here.
      const double moved = 2 * largest_pitch(baked.map()) * std::abs(side);
      double low = 1, high = 0;
      for (const double dx : {-moved, 0.0, moved})
        for (const double dy : {-moved, 0.0, moved}) {
          low = std::min(low, truth_at(p + glm::dvec3(dx, dy, 0)));
          high = std::max(high, truth_at(p + glm::dvec3(dx, dy, 0)));
        }
      const double slack = sampling_tolerance(outline_strata(kSamples), kSamples) + options.epsilon;
      const double value = static_cast<double>(look_up.at({p.x, p.y, p.z}, Filter::bilinear).attenuation);
      EXPECT_GE(value, low - slack) << p.x << " " << p.y << " " << p.z << " of " << faces;
      EXPECT_LE(value, high + slack) << p.x << " " << p.y << " " << p.z << " of " << faces;
      penumbra += truth_at(p) > 0.2 ? 1 : 0;
    }
    EXPECT_GT(penumbra, 50);
  }
}

TEST(TwoSided, EachSideIsThatOfALightOfOneSide) {
  BakeOptions options = small_options(96, 80, 16);
  const BakedMap both = bake(between_plates(), two_sided_light(1), options);
  Light front = two_sided_light(1);
  front.two_sided = false;
  Light back = light_face(two_sided_light(1), 1, 96, 80).light;
  back.two_sided = false;
  BakeOptions turned = options;
  turned.light_samples = make_light_samples(front, options.samples, options.points, options.seed);
  for (LightSample& sample : turned.light_samples) sample.position[0] = 0 - sample.position[0];
  const BakedMap one = bake(between_plates(), front, options), other = bake(between_plates(), back, turned);
  ASSERT_EQ(both.blocks.size(), 2U);
  ASSERT_EQ(one.map.coding.depth_bits, both.map.coding.depth_bits);
  EXPECT_TRUE(both.map.views[0] == one.map.views[0]);
  EXPECT_TRUE(both.map.views[1] == other.map.views[0]);
  std::size_t bytes = 0;
  for (std::size_t n = 0; n < one.blocks[0].size(); ++n) {
    EXPECT_TRUE(both.blocks[0][n].bytes == one.blocks[0][n].bytes) << n;
    EXPECT_TRUE(both.blocks[1][n].bytes == other.blocks[0][n].bytes) << n;
    bytes += other.blocks[0][n].bytes.size();
  }
  EXPECT_GT(bytes, 1000U);
}

TEST(TwoSided, IsForPlanarLightsAndTakesAllFacesOrOne) {
  const auto fault = [](const Light& light) -> std::string {
    try {
      static_cast<void>(bake(between_plates(), light, small_options(16, 16, 4)));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault(two_sided_light(1)), "");
  Light light = two_sided_light(5);
  EXPECT_EQ(fault(light), light.name + ".faces: must be 1 or 6 for two-sided lights");
  light.two_sided = false;
  light.faces = 6;
  EXPECT_EQ(fault(light), light.name + ".faces: must be 1 or 5 for planar lights");
  light = two_sided_light(1);
  light.shape = SphereLight{0.1};
  EXPECT_EQ(fault(light), light.name + ".two_sided: must be of a planar light");
}

}  // namespace
}  // namespace pdsm::test
