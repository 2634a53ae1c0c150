// SPDX-License-Identifier: Apache-2.0
// Where nothing changes around a place of a mask, against its definition place by place.
#include "trace/mask_cells.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random.h"
#include "trace/mask_alpha.h"

namespace pdsm::test {
namespace {

/// Rectangles of holes and of solid surface over each other, with a few single texels in them.
CutoutMask patched_mask(Random& random) {
  CutoutMask mask{random.count(1, 90), random.count(1, 90), {}, {}, 0.5F};
  mask.alpha.assign(std::size_t{mask.width} * mask.height, random.pick<std::uint8_t>({0, 255}));
  const int patches = static_cast<int>(random.integer(0, 4));
  for (int patch = 0; patch < patches; ++patch) {
    const std::uint32_t x0 = random.count(0, mask.width - 1), y0 = random.count(0, mask.height - 1),
                        x1 = random.count(x0, mask.width - 1), y1 = random.count(y0, mask.height - 1);
    const auto alpha = random.pick<std::uint8_t>({0, 100, 127, 128, 200, 255});
    for (std::uint32_t y = y0; y <= y1; ++y)
      for (std::uint32_t x = x0; x <= x1; ++x) mask.alpha[std::size_t{y} * mask.width + x] = alpha;
  }
  mask.alpha[random.count(0, mask.width * mask.height - 1)] = random.pick<std::uint8_t>({0, 255});
  for (MaskWrap& wrap : mask.wrap) wrap = random.pick({MaskWrap::repeat, MaskWrap::mirror, MaskWrap::clamp});
  return mask;
}

/// Whether the places within `radius` texels of `place`, of a grid with its corners and of random ones, all
/// have one answer.
bool are_alike(const CutoutMask& mask, const glm::dvec2& place, double radius, bool solid, Random& random) {
  const glm::dvec2 reach(radius / mask.width, radius / mask.height);
  for (int n = 0; n < 400; ++n) {
    const glm::dvec2 offset = n < 121 ? glm::dvec2(n % 11 - 5, n / 11 - 5) / 5.0
                                      : glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
    if (is_solid(mask, place + reach * offset) != solid) return false;
  }
  return true;
}

TEST(MaskCells, AllPlacesAroundHaveTheirAnswer) {
  Random random(81);
  int told = 0;
  for (int n = 0; n < 1000; ++n) {
    const CutoutMask mask = patched_mask(random);
    const MaskCells cells(mask);
    for (int p = 0; p < 60; ++p) {
      const glm::dvec2 place(random.uniform(-2, 3), random.uniform(-2, 3));
      const double radius = random.pick({0.0, 2.9, 6.9, 14.9});
      const MaskPart part = cells.around(place, radius);
      if (part == MaskPart::mixed) continue;
      ++told;
      ASSERT_TRUE(are_alike(mask, place, radius, part == MaskPart::solid, random))
          << mask.width << " x " << mask.height << " at " << place.x << " " << place.y << ", " << radius;
    }
  }
  EXPECT_GT(told, 1000);
}

/// A cell is 4 texels; of a mask of 64 whose border counts as a change, around its middle 7 of 8 cells are
/// alike, less the texel that a look-up has beside its own.
TEST(MaskCells, ReachAsFarAsNothingChanges) {
  CutoutMask mask{64, 64, std::vector<std::uint8_t>(64 * 64, 255), {}, 0.5F};
  const glm::dvec2 middle(32.5 / 64);
  EXPECT_EQ(MaskCells(mask).around(middle, 26.9), MaskPart::solid);
  EXPECT_EQ(MaskCells(mask).around(middle, 32), MaskPart::mixed);
  mask.alpha[32 * 64 + 42] = 0;
  EXPECT_EQ(MaskCells(mask).around(middle, 2.9), MaskPart::solid);
  EXPECT_EQ(MaskCells(mask).around(middle, 10), MaskPart::mixed);
}

TEST(MaskCells, EmptyMasksAreHoles) {
  const CutoutMask mask{64, 64, std::vector<std::uint8_t>(64 * 64, 127), {}, 0.5F};
  EXPECT_EQ(MaskCells(mask).around(glm::dvec2(0.5), 20), MaskPart::hole);
}

/// Planes that are seen edge-on have such radii.
TEST(MaskCells, RadiiThatAreNotFiniteAreMixed) {
  const CutoutMask mask{64, 64, std::vector<std::uint8_t>(64 * 64, 255), {}, 0.5F};
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(MaskCells(mask).around(glm::dvec2(0.5), infinite), MaskPart::mixed);
  EXPECT_EQ(MaskCells(mask).around(glm::dvec2(0.5), infinite - infinite), MaskPart::mixed);
}

}  // namespace
}  // namespace pdsm::test
