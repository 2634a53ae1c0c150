// SPDX-License-Identifier: Apache-2.0
// Where a mask is solid, against alpha as its definition has it.
#include "trace/mask_alpha.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random.h"

namespace pdsm::test {
namespace {

/// The texel that shows at any whole number, one step at a time.
int shown(int texel, int count, MaskWrap wrap) {
  if (wrap == MaskWrap::clamp) return std::clamp(texel, 0, count - 1);
  bool turned = false;
  while (texel < 0 || texel >= count) {
    texel += texel < 0 ? count : -count;
    turned = !turned;
  }
  return wrap == MaskWrap::mirror && turned ? count - 1 - texel : texel;
}

/// Bilinear alpha from 0 to 1, as a sum of four texels by their weights.
double reference_alpha(const CutoutMask& mask, const glm::dvec2& place) {
  const double x = place.x * mask.width - 0.5, y = place.y * mask.height - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  double sum = 0;
  for (int b = 0; b < 2; ++b) {
    for (int a = 0; a < 2; ++a) {
      const int column = shown(i + a, static_cast<int>(mask.width), mask.wrap[0]),
                row = shown(j + b, static_cast<int>(mask.height), mask.wrap[1]);
      const double weight = (a == 0 ? 1 - (x - i) : x - i) * (b == 0 ? 1 - (y - j) : y - j);
      sum +=
          weight * mask.alpha[static_cast<std::size_t>(row) * mask.width + static_cast<std::size_t>(column)];
    }
  }
  return sum / 255;
}

TEST(MaskAlpha, IsLinearBetweenTexelCentresInEveryWrapMode) {
  Random random(71);
  for (int n = 0; n < 200; ++n) {
    CutoutMask mask{static_cast<std::uint32_t>(random.pick({1, 2, 5})),
                    static_cast<std::uint32_t>(random.pick({1, 3, 4})),
                    {},
                    {},
                    static_cast<float>(random.uniform(0.1, 0.9))};
    for (std::uint32_t t = 0; t < mask.width * mask.height; ++t)
      mask.alpha.push_back(static_cast<std::uint8_t>(random.uniform(0, 255.99)));
    for (MaskWrap& wrap : mask.wrap)
      wrap = random.pick({MaskWrap::repeat, MaskWrap::mirror, MaskWrap::clamp});
    for (int p = 0; p < 200; ++p) {
      const glm::dvec2 place(random.uniform(-7, 7), random.uniform(-7, 7));
      const double above = reference_alpha(mask, place) - static_cast<double>(mask.cutoff);
      // Up to the rounding of a few doubles.
      if (std::abs(above) < 1e-12) continue;
      ASSERT_EQ(is_solid(mask, place), above > 0) << place.x << " " << place.y;
    }
  }
}

TEST(MaskAlpha, ACutoffOfOneLeavesWhatIsOpaque) {
  const CutoutMask mask{3, 3, std::vector<std::uint8_t>(9, 255), {}, 1};
  Random random(72);
  for (int n = 0; n < 1000; ++n) EXPECT_TRUE(is_solid(mask, {random.uniform(-2, 2), random.uniform(-2, 2)}));
}

TEST(MaskAlpha, PlacesFarBeyondIntegers) {
  const CutoutMask mask{2, 2, {255, 255, 255, 255}, {MaskWrap::repeat, MaskWrap::mirror}, 0.5F};
  for (const double far : {1e10, -1e18, 1e300}) EXPECT_TRUE(is_solid(mask, {far, -far})) << far;
}

}  // namespace
}  // namespace pdsm::test
