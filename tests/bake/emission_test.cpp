// SPDX-License-Identifier: Apache-2.0
// Lights with a picture: as many samples lie in a part as it emits of the whole, and V is the emission's
// share.
#include <gtest/gtest.h>

#include <limits>

#include "light/emission_warp.h"
#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/exact_truth.h"
#include "support/half_plane_shadow.h"

namespace pdsm::test {
namespace {

constexpr double kOccluder = 3, kFar = 8;

std::shared_ptr<const EmissionImage> picture(std::uint32_t width, std::uint32_t height,
                                             std::vector<float> luminance) {
  return std::make_shared<const EmissionImage>(EmissionImage{width, height, std::move(luminance)});
}

TEST(EmissionWarp, GivesEachTexelItsShare) {
  // Shares of rows and, within them, of texels are multiples of 1/16: a grid of 16 x 16 falls apart exactly.
  const EmissionWarp warp(*picture(2, 2, {1, 3, 0, 4}));
  std::array<int, 4> count{};
  for (int i = 0; i < 256; ++i) {
    const auto [x, y] = warp({(i % 16 + 0.5) / 16, (static_cast<double>(i / 16) + 0.5) / 16});
    ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1);
    ++count[(y < 0.5 ? 0U : 2U) + (x < 0.5 ? 0U : 1U)];
  }
  EXPECT_EQ(count, (std::array<int, 4>{32, 96, 0, 128}));
}

TEST(EmissionWarp, IsLinearWithinTexels) {
  const EmissionWarp warp(*picture(2, 1, {1, 3}));
  EXPECT_DOUBLE_EQ(warp({0.125, 0.3})[0], 0.25);
  EXPECT_DOUBLE_EQ(warp({0.625, 0.3})[0], 0.75);
  EXPECT_DOUBLE_EQ(warp({0.625, 0.3})[1], 0.3);
}

TEST(EmissionWarp, NeverEndsInTheDark) {
  // Dark borders all around, and sums that don't end where the last bright texel does.
  const auto image = picture(5, 4, {0, 0, 0, 0, 0, 0, 0.1F, 0, 0.7F, 0, 0, 0.3F, 0, 0, 0, 0, 0, 0, 0, 0});
  const EmissionWarp warp(*image);
  const double last = 1 - std::numeric_limits<double>::epsilon() / 2;
  for (const double u : {0.0, 0.1, 0.125, 0.5, 0.7272727272727273, 0.99, last}) {
    for (const double v : {0.0, 0.1, 0.5, 0.7272727272727273, 0.99, last}) {
      const auto [x, y] = warp({u, v});
      // A texel's far border counts as its own.
      const auto on = [&](double a, double b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        return i < 5 && j < 4 && image->luminance[5 * j + i] > 0;
      };
      const double a = 5 * x, b = 4 * y, tiny = 1e-12;
      EXPECT_TRUE(on(a, b) || on(a - tiny, b) || on(a, b - tiny) || on(a - tiny, b - tiny)) << u << " " << v;
    }
  }
}

TEST(Emission, TwoHalvesBehindAnEdge) {
  Light light = rect_light(2, 1);
  light.emission = picture(2, 1, {1, 3});
  // The edge is one in the square that is warped, too.
  expect_half_plane_shadow(light, edge_strata(256), [](double edge, double slope, double depth) {
    return two_halves(back_project(edge, kOccluder, slope, depth), 1, 3);
  });
}

TEST(Emission, APictureOfOneTexelChangesNoFunction) {
  Light light = rect_light(2, 1);
  set_view(light, 0.5, 0.25, 2, kFar);
  Scene scene;
  add(scene, Plate{0.3, -kWide, kWide, kWide, kOccluder});
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  const BakedFunctions plain(scene, light, small_options(33, 5, 64));
  light.emission = picture(1, 1, {1});
  const BakedFunctions lit(scene, light, small_options(33, 5, 64));
  expect_same_level(plain, lit, 0);
  // What is told of the map is not the same, and so is its key.
  EXPECT_NE(plain.report().key, lit.report().key);
}

TEST(Emission, OneSampleIsTheMiddleOfWhatIsEmitted) {
  Light light = rect_light(2, 1);
  light.emission = picture(4, 1, {0, 0, 0, 1});
  for (const PointSet points : {PointSet::lattice, PointSet::jittered}) {
    const auto samples = make_light_samples(light, 1, points, 3);
    EXPECT_DOUBLE_EQ(samples[0].position[0], 0.75);
    EXPECT_DOUBLE_EQ(samples[0].position[1], 0);
  }
}

TEST(Emission, ALineTakesItsPictureAlong) {
  Light light = rect_light(0, 2);
  light.emission = picture(1, 2, {1, 3});
  int above = 0;
  for (const LightSample& sample : make_light_samples(light, 400, PointSet::lattice, 0))
    above += sample.position[1] > 0 ? 1 : 0;
  EXPECT_EQ(above, 300);
}

TEST(Emission, RefusesWhatIsNoPicture) {
  const auto fault = [](Light light, std::shared_ptr<const EmissionImage> image) -> std::string {
    light.emission = std::move(image);
    try {
      check_emission(light);
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      return error.what();
    }
    return "";
  };
  const Light rect = rect_light(1, 1);
  const std::string name = rect.name + ".emission: ";
  EXPECT_EQ(fault(rect, nullptr), "");
  EXPECT_EQ(fault(rect, picture(2, 1, {0, 1})), "");
  EXPECT_EQ(fault(rect, picture(2, 1, {0, 0})), name + "is black");
  EXPECT_EQ(fault(rect, picture(2, 1, {1, -1})), name + "must be finite and not negative");
  EXPECT_EQ(fault(rect, picture(1, 1, {NAN})), name + "must be finite and not negative");
  for (const auto& image : {picture(2, 2, {1, 1}), picture(0, 1, {}), picture(8193, 1, {1})})
    EXPECT_EQ(fault(rect, image).find(name + "must have as many values"), 0U);
  Light sphere = rect;
  sphere.shape = SphereLight{1};
  EXPECT_EQ(fault(sphere, picture(1, 1, {1})), name + "must be of a rect or disk light");
}

}  // namespace
}  // namespace pdsm::test
