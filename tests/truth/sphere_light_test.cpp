// SPDX-License-Identifier: Apache-2.0
// Sphere lights: what is seen of them, the model that is baked, and maps of six views.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pdsm/runtime/look_up.h"
#include "plates.h"
#include "truth/light_points.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

constexpr double kRadius = 0.2;

Light bulb() {
  return light_at_origin(SphereLight{kRadius});
}

/// A square of edge 2 `half` around `centre`, across `axis`.
Geometry square(int axis, const glm::vec3& centre, float half) {
  glm::vec3 u(0), v(0);
  u[(axis + 1) % 3] = half;
  v[(axis + 2) % 3] = half;
  return quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v);
}

/// Share of the sphere's model that the square keeps from `p`, by uniform points of the unit sphere of four
/// dimensions: a million, so good to 0.0005.
double blocked_share(int axis, const glm::vec3& centre, float half, const glm::dvec3& p) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  constexpr int kCount = 1'000'000;
  int blocked = 0;
  for (int n = 0; n < kCount; ++n) {
    const glm::dvec4 q(normal(engine), normal(engine), normal(engine), normal(engine));
    const glm::dvec3 s = kRadius / glm::length(q) * glm::dvec3(q);
    const double t = (static_cast<double>(centre[axis]) - p[axis]) / (s[axis] - p[axis]);
    const glm::dvec3 off = glm::abs(p + t * (s - p) - glm::dvec3(centre));
    const double most = static_cast<double>(half);
    blocked += t > 0 && t < 1 && off[(axis + 1) % 3] < most && off[(axis + 2) % 3] < most ? 1 : 0;
  }
  return static_cast<double>(blocked) / kCount;
}

TEST(SphereLight, VisibleCapPointsAreUniformInSolidAngle) {
  const glm::dvec3 from(0.3, -0.5, 0.8);
  const double distance = glm::length(from);
  const double most = 1 - std::sqrt(1 - kRadius * kRadius / (distance * distance));
  const JitteredGrid grid(4096);
  double mean = 0;
  glm::dvec3 sum(0);
  for (std::uint32_t n = 0; n < 4096; ++n) {
    const glm::dvec3 p = visible_cap_point(kRadius, from, grid.point(n, 3));
    ASSERT_NEAR(glm::length(p), kRadius, 1e-12);
    const glm::dvec3 direction = glm::normalize(p - from);
    // It is seen: the surface there faces the point.
    ASSERT_LE(glm::dot(p, direction), 1e-9);
    const double height = 1 - glm::dot(direction, -from / distance);
    ASSERT_LE(height, most * (1 + 1e-9));
    mean += height / 4096;
    sum += direction;
  }
  // Heights are uniform. Strata of a 64 x 64 grid leave their mean within 1/64 of the range.
  EXPECT_NEAR(mean, most / 2, most / 64);
  EXPECT_LT(glm::length(glm::cross(glm::normalize(sum), -from / distance)), 0.01);
}

TEST(SphereLight, TheModelIsTheVisibleCapFromAfar) {
  // A straight edge, at the distances of docs/maths.md with what the model differs by there, and 0.004 for
  // the sampling of both by 65536 jittered points: a row of 256 strata that the edge cuts, half of each off.
  for (const auto& [distance, differs] : {std::pair(2.0, 0.016), {3.0, 0.006}, {5.0, 0.002}, {10.0, 0.0}}) {
    Scene scene;
    const double z = 0.6 * distance * kRadius;
    scene.geometry = {quad({0.03, -9, z + 0.2}, {9, -9, z + 0.2}, {9, 9, z + 0.2}, {0.03, 9, z + 0.2})};
    if (distance < 3) scene.geometry = {quad({0.03, -9, 0.25}, {9, -9, 0.25}, {9, 9, 0.25}, {0.03, 9, 0.25})};
    const ShadowRays rays(scene, bulb(), 0.1);
    for (const double x : {-0.05, 0.0, 0.02, 0.08}) {
      const glm::dvec3 p(x, 0.01, std::sqrt(std::pow(distance * kRadius, 2) - x * x));
      EXPECT_NEAR(rays.attenuation(p, 65536, 1), rays.model_rgb(p, 65536, 2)[0], differs + 0.004)
          << distance << " " << x;
    }
  }
}

TEST(SphereLight, NothingIsKeptFromPointsWithin) {
  Scene scene;
  scene.geometry = {square(2, {0, 0, 0.1F}, 1)};
  const ShadowRays rays(scene, bulb(), 0.1);
  EXPECT_EQ(rays.attenuation({0, 0, 0.15}, 64, 1), 0);
  EXPECT_EQ(rays.attenuation({0, 0, 0.3}, 64, 1), 0);
  EXPECT_EQ(rays.attenuation({0, 0, -3}, 64, 1), 0);
}

/// A map of the bulb with a square of edge 0.5 at distance 1.5 along each of six axes.
class SixSquares : public ::testing::Test {
 protected:
  static constexpr float kHalf = 0.25F, kAway = 1.5F;
  static constexpr std::uint32_t kSize = 256, kSamples = 512;
  static constexpr double kEpsilon = 0.01;

  static glm::vec3 centre(int axis, float sign) {
    glm::vec3 c(0.1F, -0.05F, 0.07F);
    c[axis] = sign * kAway;
    return c;
  }
  static const PenumbraMap& map() {
    static const PenumbraMap kMap = [] {
      Scene scene;
      for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0F, 1.0F})
          scene.geometry.push_back(square(axis, centre(axis, sign), kHalf));
      BakeOptions options;
      options.samples = kSamples;
      options.width = options.height = kSize;
      options.epsilon = kEpsilon;
      options.receivers = Receivers::all;
      Light light = bulb();
      light.far_depth = 4;
      return decode_blocks(bake(scene, light, options));
    }();
    return kMap;
  }
  /// What a look-up may be off at distance z along an axis: the fit; the samples, as many as a random set's
  /// two standard errors; and a texel of the look-up and half a one of the maps, of 2/254, on the penumbra,
  /// whose steepest slope is that of a disk of diameter 2 r at its middle: 4 / pi of the mean one. As seen
  /// from z, the light's edge is 2 r (z - d) / d wide behind an edge at d.
  static double tolerance(double z) {
    const double penumbra = 2 * kRadius * (z - static_cast<double>(kAway)) / static_cast<double>(kAway);
    return kEpsilon + 1 / std::sqrt(static_cast<double>(kSamples)) +
           4 / std::numbers::pi * 1.5 * (2.0 / 254) * z / penumbra;
  }
};

TEST_F(SixSquares, AreDarkerByTheModelsShareOnAllSides) {
  const PenumbraLookUp look_up(map());
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      for (const double across : {0.1, 0.5, 0.62, 0.75, 0.9}) {
        glm::dvec3 p(0.15, -0.1, 0.12);
        p[axis] = static_cast<double>(sign) * 3;
        p[(axis + 1) % 3] += across - 0.1;
        const double truth = blocked_share(axis, centre(axis, sign), kHalf, p);
        EXPECT_NEAR(static_cast<double>(look_up.at({p.x, p.y, p.z}, Filter::bilinear).attenuation), truth,
                    tolerance(3))
            << axis << " " << sign << " " << across;
      }
    }
  }
}

TEST_F(SixSquares, NeighbouringViewsAgreeAtTheirSeams) {
  Scene scene;
  // Squares on the diagonals throw shadows across the seams.
  for (const glm::vec3& c : {glm::vec3(1.2F, 0, 1.2F), {0, -1.2F, 1.2F}, {-1.2F, 1.2F, 0}})
    scene.geometry.push_back(square(std::abs(c.z) > 0 ? 2 : 1, c, 0.3F));
  BakeOptions options;
  options.samples = kSamples;
  options.width = options.height = 128;
  options.epsilon = kEpsilon;
  options.receivers = Receivers::all;
  Light light = bulb();
  light.far_depth = 4;
  const PenumbraMap seams = decode_blocks(bake(scene, light, options));
  const PenumbraLookUp look_up(seams);
  // Each view's fit; and on the steepest slope of a penumbra, as in tolerance(), a step of the look-up and
  // the half texel for which a view's last value holds beyond its last centre.
  const double penumbra = 2 * kRadius * (2.6 - 1.2) / 1.2;
  const double jump =
      2 * kEpsilon + 4 / std::numbers::pi * 2.6 * (std::numbers::sqrt2 * 0.002 + 1.0 / 126) / penumbra;
  double darkest = 0;
  for (double across = -0.8; across <= 0.8; across += 0.02) {
    for (const auto& [a, b] : {std::pair(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)),
                               std::pair(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)),
                               std::pair(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0))}) {
      const glm::dvec3 along = glm::cross(a, b);
      // From one side of the seam, over both texels of the overlap, to the other.
      std::vector<double> values;
      for (double shift = -0.06; shift <= 0.06; shift += 0.002) {
        const glm::dvec3 p = 2.6 * ((1 + shift) * a + (1 - shift) * b) + 2.6 * across * along;
        values.push_back(static_cast<double>(look_up.at({p.x, p.y, p.z}, Filter::bilinear).attenuation));
        darkest = std::max(darkest, values.back());
      }
      for (std::size_t n = 1; n < values.size(); ++n) EXPECT_NEAR(values[n], values[n - 1], jump) << across;
    }
  }
  EXPECT_GT(darkest, 0.3);
}

}  // namespace
}  // namespace pdsm
