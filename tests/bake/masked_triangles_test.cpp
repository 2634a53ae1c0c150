// SPDX-License-Identifier: Apache-2.0
#include "trace/masked_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random.h"

namespace pdsm::test {
namespace {

glm::vec3 random_point(Random& random) {
  return glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(1, 3));
}

/// Texels of the mask by which places differ that are a metre apart in the triangle's plane, at `angle` to
/// its first edge.
double texels_of_a_metre(const MaskedTriangle& triangle, const CutoutMask& mask, double angle) {
  const glm::dvec3 a(triangle.corners[0]), e1 = glm::dvec3(triangle.corners[1]) - a,
                                           e2 = glm::dvec3(triangle.corners[2]) - a;
  const glm::dvec3 x = glm::normalize(e1), y = glm::normalize(e2 - x * glm::dot(e2, x));
  // w1 e1 + w2 e2 = cos x + sin y
  const double w2 = std::sin(angle) / glm::dot(e2, y),
               w1 = (std::cos(angle) - w2 * glm::dot(e2, x)) / glm::length(e1);
  const glm::dvec2 places =
      w1 * (triangle.places[1] - triangle.places[0]) + w2 * (triangle.places[2] - triangle.places[0]);
  return glm::length(places * glm::dvec2(mask.width, mask.height));
}

TEST(MaskedTriangles, AMetreIsAsManyTexelsAsInTheDirectionOfMost) {
  Random random(91);
  CutoutMask mask{40, 300, {}, {}, 0.5F};
  for (int n = 0; n < 200; ++n) {
    MaskedTriangle triangle;
    for (glm::vec3& corner : triangle.corners) corner = random_point(random);
    for (glm::dvec2& place : triangle.places) place = {random.uniform(), random.uniform()};
    double most = 0;
    constexpr int kAngles = 2000;
    for (int k = 0; k < kAngles; ++k)
      most = std::max(most, texels_of_a_metre(triangle, mask, std::numbers::pi * k / kAngles));
    const double told = mask_texels_per_metre(triangle, mask);
    // The angle nearest to the best is half a step off it at the most: lengths there are at least its cosine.
    EXPECT_LE(most, told * (1 + 1e-9));
    EXPECT_GE(most, told * std::cos(std::numbers::pi / kAngles));
  }
}

TEST(MaskedTriangles, CopiesHaveOneKeyHoweverWound) {
  Random random(92);
  MaskedTriangle triangle;
  for (glm::vec3& corner : triangle.corners) corner = random_point(random);
  MaskedTriangle copy = triangle;
  std::swap(copy.corners[0], copy.corners[1]);
  EXPECT_EQ(triangle_key(copy), triangle_key(triangle));
  copy.corners[2].x = std::nextafter(copy.corners[2].x, 9.0F);
  EXPECT_NE(triangle_key(copy), triangle_key(triangle));
}

}  // namespace
}  // namespace pdsm::test
