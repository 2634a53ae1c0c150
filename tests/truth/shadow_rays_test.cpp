// SPDX-License-Identifier: Apache-2.0
#include "truth/shadow_rays.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plates.h"
#include "truth/random.h"

namespace pdsm {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kSide = 32, kSamples = kSide * kSide;
/// Failure probability of one comparison, and log(2 / it).
constexpr double kLogFailure = 14.508657738524219;  // ln(2e6)

/// What n x n jittered samples may be off when `crossed` of their strata hold an edge (Hoeffding), plus what
/// a ray may be off by rounding.
double tolerance(double crossed) {
  return std::sqrt(crossed * kLogFailure / 2) / kSamples + 1e-6;
}
/// Strata that one straight edge crosses, and that a closed convex outline crosses.
constexpr double kLineStrata = 2 * kSide - 1, kOutlineStrata = 4 * kSide - 4;

Scene scene_of(std::vector<Geometry> geometry, const Light& light) {
  Scene scene;
  scene.geometry = std::move(geometry);
  scene.lights = {light};
  return scene;
}

/// Shadow rays through a few casters from one light.
ShadowRays rays_through(std::vector<Geometry> geometry, const Light& light, double near_depth = 0.1) {
  return {scene_of(std::move(geometry), light), light, near_depth};
}

/// Where the edge x = a at depth h appears on the light, seen from the point of slope d at depth z.
double back_projected(double a, double h, double d, double z) {
  return z * (a - h * d) / (z - h);
}

double overlap(double low, double high, double size) {
  return std::max(0.0, std::min(high, size / 2) - std::max(low, -size / 2));
}

/// Share of a square of side l beyond a line at distance t from its centre, its normal at `angle`.
double square_tail(double l, double angle, double t) {
  const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
  const double a = l * std::max(c, s), b = l * std::min(c, s), tau = std::abs(t);
  double tail = 0;
  if (tau <= (a - b) / 2) {
    tail = 0.5 - tau / a;
  } else if (tau < (a + b) / 2) {
    tail = std::pow((a + b) / 2 - tau, 2) / (2 * a * b);
  }
  return t >= 0 ? tail : 1 - tail;
}

/// Share of a disk of radius r beyond a line at distance t from its centre.
double disk_tail(double r, double t) {
  const double u = t / r;
  if (u <= -1) return 1;
  if (u >= 1) return 0;
  return (std::acos(u) - u * std::sqrt(1 - u * u)) / kPi;
}

TEST(ShadowRays, RectPlateIsExact) {
  const double width = 2, height = 1, h = 4;
  const ShadowRays rays =
      rays_through({plate(-0.3, -0.2, 0.5, 0.4, h)}, light_at_origin(RectLight{width, height}));
  for (const double z : {4.5, 6.0, 8.0, 15.0}) {
    for (const double dx : {-0.1, 0.0, 0.07}) {
      for (const double dy : {-0.05, 0.02}) {
        const double x = overlap(back_projected(-0.3, h, dx, z), back_projected(0.5, h, dx, z), width);
        const double y = overlap(back_projected(-0.2, h, dy, z), back_projected(0.4, h, dy, z), height);
        const double expected = x * y / (width * height);
        EXPECT_NEAR(rays.attenuation({dx * z, dy * z, z}, kSamples, 1), expected, tolerance(kOutlineStrata))
            << "slope " << dx << " " << dy << " depth " << z;
      }
    }
  }
}

TEST(ShadowRays, InFrontOfThePlateIsLit) {
  const ShadowRays rays = rays_through({plate(-9, -9, 9, 9, 4)}, light_at_origin(RectLight{2, 1}));
  EXPECT_EQ(rays.attenuation({0.1, 0.2, 3.99}, kSamples, 1), 0);
  EXPECT_EQ(rays.attenuation({0.1, 0.2, 4.1}, kSamples, 1), 1);
}

TEST(ShadowRays, HalfPlaneAtAnAngleIsExact) {
  const double side = 1.5, h = 3, z = 7;
  for (int step = 0; step < 16; ++step) {
    const double angle = 0.1 + step * kPi / 8;
    for (const double a : {-0.55, -0.3, -0.05, 0.0, 0.2, 0.5}) {
      const ShadowRays rays = rays_through({half_plane(angle, a, h)}, light_at_origin(RectLight{side, side}));
      const double expected = square_tail(side, angle, z * a / (z - h));
      EXPECT_NEAR(rays.attenuation({0, 0, z}, kSamples, 2), expected, tolerance(kLineStrata))
          << "angle " << angle << " edge " << a;
    }
  }
}

TEST(ShadowRays, EdgeOnTheRayIsOneHalf) {
  const double slope = 0.2, h = 3;
  const ShadowRays rays = rays_through({half_plane(0, h * slope, h)}, light_at_origin(RectLight{2, 2}));
  for (const double z : {3.1, 4.0, 10.0, 50.0}) {
    EXPECT_NEAR(rays.attenuation({slope * z, 0, z}, kSamples, 3), 0.5, tolerance(kLineStrata)) << z;
  }
}

TEST(ShadowRays, DiskAndHalfPlaneAreExact) {
  const double radius = 0.8, h = 3, z = 7;
  for (int step = 0; step < 8; ++step) {
    const double angle = 0.05 + step * kPi / 4;
    for (const double a : {-0.5, -0.2, 0.0, 0.1, 0.3, 0.44}) {
      const ShadowRays rays = rays_through({half_plane(angle, a, h)}, light_at_origin(DiskLight{radius}));
      const double expected = disk_tail(radius, z * a / (z - h));
      // A line's preimage in the square is bent; a convex outline crosses at least as many strata.
      EXPECT_NEAR(rays.attenuation({0, 0, z}, kSamples, 4), expected, tolerance(kOutlineStrata))
          << "angle " << angle << " edge " << a;
    }
  }
}

TEST(ShadowRays, SphereOnTheAxisIsExact) {
  const double radius = 0.4, h = 4;
  constexpr std::uint32_t kRings = 200;
  const Geometry ball = sphere({0, 0, h}, radius, kRings);
  const double flattened = std::cos(kPi / kRings);  // inner radius of the mesh; its outline is as much off
  for (const double z : {6.0, 8.0, 16.0}) {
    const auto shadow = [&](double r) { return z * r / std::sqrt((z - h) * (z - h) - r * r); };
    const double rho = shadow(radius),
                 mesh_error = 1 - std::pow(shadow(radius * flattened * flattened) / rho, 2);
    const double light_radius = 1.6, side = 4;
    const double on_disk = std::min(1.0, rho * rho / (light_radius * light_radius));
    const double on_square = kPi * rho * rho / (side * side);
    ASSERT_LE(rho, side / 2);
    const ShadowRays disk = rays_through({ball}, light_at_origin(DiskLight{light_radius}));
    const ShadowRays square = rays_through({ball}, light_at_origin(RectLight{side, side}));
    EXPECT_NEAR(disk.attenuation({0, 0, z}, kSamples, 5), on_disk, tolerance(kOutlineStrata) + mesh_error)
        << z;
    EXPECT_NEAR(square.attenuation({0, 0, z}, kSamples, 5), on_square, tolerance(kOutlineStrata) + mesh_error)
        << z;
  }
}

TEST(ShadowRays, TakeLightFramesAsTheyAre) {
  // The plate of RectPlateIsExact, moved with its light: the attenuation is the same.
  Light light = light_at_origin(RectLight{2, 1});
  light.position = {3, 8, -2};
  light.direction = {1, -3, 0.5};
  light.up = glm::dvec3{0.2, 0.1, 1};
  const RigidTransform to_world = inverse(light_frame(light));
  Geometry moved = plate(-0.3, -0.2, 0.5, 0.4, 4);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      moved.local_to_world[column][row] = to_world.rotation[static_cast<std::size_t>(3 * row + column)];
    }
  }
  moved.local_to_world[3] = glm::dvec4(apply(to_world, glm::dvec3(0)), 1);
  const ShadowRays there = rays_through({moved}, light);
  const ShadowRays here = rays_through({plate(-0.3, -0.2, 0.5, 0.4, 4)}, light_at_origin(RectLight{2, 1}));
  for (const double z : {4.5, 6.0, 12.0}) {
    const glm::dvec3 p(0.03 * z, -0.02 * z, z);
    // The same samples: rounding may move single rays across the outline.
    EXPECT_NEAR(there.attenuation(apply(to_world, p), kSamples, 6), here.attenuation(p, kSamples, 6),
                3.0 / kSamples);
  }
}

TEST(ShadowRays, FarFromTheOriginNothingIsLost) {
  const glm::dvec3 away(1e6, -1e6, 1e6);
  Light light = light_at_origin(RectLight{2, 1});
  const ShadowRays here = rays_through({plate(-0.3, -0.2, 0.5, 0.4, 4)}, light);
  Geometry moved = plate(-0.3, -0.2, 0.5, 0.4, 4);
  moved.local_to_world[3] = glm::dvec4(away, 1);
  light.position = away;
  const ShadowRays there = rays_through({moved}, light);
  for (const double z : {4.5, 6.0, 12.0}) {
    const glm::dvec3 p(0.03 * z, -0.02 * z, z);
    EXPECT_NEAR(there.attenuation(p + away, kSamples, 7), here.attenuation(p, kSamples, 7), 3.0 / kSamples);
  }
}

TEST(ShadowRays, ScaleDoesNotMatter) {
  for (const double scale : {0x1p-20, 0x1p20}) {
    Geometry scaled = plate(-0.3, -0.2, 0.5, 0.4, 4);
    scaled.local_to_world = glm::dmat4(scale);
    scaled.local_to_world[3][3] = 1;
    const ShadowRays there =
        rays_through({scaled}, light_at_origin(RectLight{2 * scale, 1 * scale}), 0.1 * scale);
    const ShadowRays here = rays_through({plate(-0.3, -0.2, 0.5, 0.4, 4)}, light_at_origin(RectLight{2, 1}));
    const glm::dvec3 p(0.2, -0.1, 7);
    EXPECT_EQ(there.attenuation(scale * p, kSamples, 8), here.attenuation(p, kSamples, 8)) << scale;
  }
}

TEST(ShadowRays, BehindTheLightIsZero) {
  const ShadowRays rays =
      rays_through({plate(-9, -9, 9, 9, -1), plate(-9, -9, 9, 9, 1)}, light_at_origin(RectLight{}));
  EXPECT_EQ(rays.attenuation({0, 0, -2}, 64, 0), 0);
  EXPECT_EQ(rays.attenuation({0, 0, 0}, 64, 0), 0);
  EXPECT_EQ(rays.attenuation({0, 0, 2}, 64, 0), 1);
}

TEST(ShadowRays, EmitterNeverBlocks) {
  // A lamp's own panel in the plane of the light, and one a little in front of what counts as emitter.
  const double near_depth = 2, emitter = 1e-4 * near_depth;
  const Light light = light_at_origin(RectLight{1, 1});
  const glm::dvec3 p(0.3, 0.1, 500);
  EXPECT_EQ(rays_through({plate(-3, -3, 3, 3, 0)}, light, near_depth).attenuation(p, 256, 0), 0);
  EXPECT_EQ(rays_through({plate(-3, -3, 3, 3, 0.9 * emitter)}, light, near_depth).attenuation(p, 256, 0), 0);
  EXPECT_EQ(rays_through({plate(-3, -3, 3, 3, 0.01)}, light, near_depth).attenuation(p, 256, 0), 1);
  // From so far away, a float can't tell the ray's end from the panel.
  EXPECT_EQ(rays_through({plate(-3, -3, 3, 3, 0)}, light, 0.1).attenuation({0.3, 0.1, 9000}, 256, 0), 0);
}

TEST(ShadowRays, CasterThroughTheEmitterBlocksInFrontOnly) {
  // A wall across the light that reaches from behind it to z = 1: half of the light is beyond it.
  const Geometry wall = quad({0, -9, -5}, {0, 9, -5}, {0, 9, 1}, {0, -9, 1});
  const ShadowRays rays = rays_through({wall}, light_at_origin(RectLight{1, 1}), 0.5);
  EXPECT_NEAR(rays.attenuation({2, 0, 3}, kSamples, 0), 0.5, tolerance(kLineStrata));
  EXPECT_EQ(rays.attenuation({2, 0, 30}, 16, 0), rays.attenuation({-2, 0, 30}, 16, 0));
}

TEST(ShadowRays, OnlyCastersBlock) {
  Geometry ghost = plate(-9, -9, 9, 9, 4);
  ghost.casts = false;
  EXPECT_EQ(rays_through({ghost}, light_at_origin(RectLight{})).attenuation({0, 0, 8}, 64, 0), 0);
  EXPECT_EQ(rays_through({}, light_at_origin(RectLight{})).attenuation({0, 0, 8}, 64, 0), 0);
}

TEST(ShadowRays, SurfaceDoesNotShadowItself) {
  const Geometry slope = quad({-9, -9, 2}, {9, -9, 10}, {9, 9, 10}, {-9, 9, 2});
  const ShadowRays rays = rays_through({slope}, light_at_origin(RectLight{1, 1}));
  for (const double x : {-5.0, -1.0, 0.0, 3.3, 8.0}) {
    EXPECT_EQ(rays.attenuation({x, 0.7, 6 + x * 4 / 9}, 256, 0), 0) << x;
  }
}

TEST(ShadowRays, AnyNumberOfSamples) {
  const ShadowRays rays = rays_through({half_plane(0, 0, 3)}, light_at_origin(RectLight{2, 2}));
  for (const std::uint32_t samples : {1U, 2U, 3U, 15U, 16U, 17U, 31U, 100U, 1000U}) {
    const double v = rays.attenuation({0, 0, 6}, samples, 9);
    const double crossed = 2 * std::sqrt(samples) + 3;
    EXPECT_NEAR(v, 0.5, crossed / samples) << samples;
    EXPECT_NEAR(v * samples, std::round(v * samples), 1e-9) << samples;
  }
}

TEST(ShadowRays, ThreadsDoNotMatter) {
  const ShadowRays rays = rays_through({plate(-0.3, -0.2, 0.5, 0.4, 4)}, light_at_origin(RectLight{2, 1}));
  std::vector<glm::dvec3> points;
  for (std::uint64_t i = 0; i < 200; ++i) {
    points.emplace_back(hash_unit(1, 3 * i) - 0.5, hash_unit(1, 3 * i + 1) - 0.5,
                        5 + hash_unit(1, 3 * i + 2));
  }
  const int all = omp_get_max_threads();
  const auto with_threads = [&](int threads) {
    omp_set_num_threads(threads);
    return rays.attenuations(points, 100, 10);
  };
  const std::vector<double> one = with_threads(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(with_threads(threads), one) << threads;
  omp_set_num_threads(all);
  EXPECT_GT(*std::max_element(one.begin(), one.end()), 0);
}

TEST(ShadowRays, SameSeedGivesPointsOneAnswer) {
  const ShadowRays rays = rays_through({half_plane(0.3, 0, 3)}, light_at_origin(RectLight{2, 2}));
  const std::vector<glm::dvec3> points(20, glm::dvec3(0.1, 0, 6));
  const std::vector<double> same = rays.attenuations(points, 64, 11, true);
  EXPECT_EQ(std::count(same.begin(), same.end(), same.front()), 20);
  const std::vector<double> own = rays.attenuations(points, 64, 11);
  EXPECT_LT(std::count(own.begin(), own.end(), own.front()), 20);
}

TEST(CasterBias, HoldsThePlaneOverTheReach) {
  // On the plane n . P = c the depth along direction d is c / (n . d). The bias is how much farther it gets
  // at most when d.x and d.y change by the reach.
  for (std::uint64_t n = 0; n < 200; ++n) {
    const auto unit = [n](std::uint64_t i) { return 2 * hash_unit(n, i) - 1; };
    const glm::dvec3 normal = glm::normalize(glm::dvec3(unit(0), unit(1), unit(2)));
    const glm::dvec3 d(0.4 * unit(3), 0.4 * unit(4), 1);
    const LightPoint from{glm::dvec3(0), {0.01, 0.02}};
    const double c = 3 * std::abs(glm::dot(normal, d));
    double farthest = 0, least = 1;
    for (const double x : {-0.01, 0.01}) {
      for (const double y : {-0.02, 0.02}) {
        const double facing = std::abs(glm::dot(normal, d + glm::dvec3(x, y, 0)));
        const bool other_side = glm::dot(normal, d + glm::dvec3(x, y, 0)) * glm::dot(normal, d) <= 0;
        least = other_side ? 0 : std::min(least, facing);
        farthest = std::max(farthest, c / facing);
      }
    }
    const double bias = slope_bias({0.5, 9}, from, 2.0 * normal, d, 3);
    if (least > 0 && farthest < 12 - 1e-9)
      EXPECT_NEAR(bias, farthest - 3, 1e-9 * farthest) << n;
    else
      EXPECT_EQ(bias, 9) << n;
  }
}

TEST(ShadowRays, GivenPointsAreShadedWithAndWithoutBias) {
  const Light light = light_at_origin(RectLight{1, 1});
  const ShadowRays rays = rays_through({plate(0.1, -9, 9, 9, 4)}, light);
  // From (0, 0, 5) the plate hides the points of the light with x > 0.5 - ...: its edge at 0.1 is seen where
  // x = 0 + (0.1 - 0) * 5 / 1.
  std::vector<LightPoint> points;
  for (int n = 0; n < 37; ++n) points.push_back({glm::dvec3(-0.5 + n / 36.0, 0.2, 0), {0, 0}});
  const glm::dvec3 p(0.12, 0, 5);
  // A line from s to p passes depth 4 at s + 0.8 (p - s) = 0.2 s + 0.096: blocked where s > 0.02.
  const auto expected = static_cast<double>(
      std::count_if(points.begin(), points.end(), [](const LightPoint& l) { return l.position.x > 0.02; }));
  EXPECT_DOUBLE_EQ(rays.attenuation(p, points), expected / 37);
  // The plate is 1 m in front of the point: a bias of less hides nothing, one of more all.
  const CasterBias less{0.999, 9}, more{1.001, 9};
  EXPECT_DOUBLE_EQ(rays.attenuation(p, points, &less), expected / 37);
  EXPECT_EQ(rays.attenuation(p, points, &more), 0);
  // Behind one caster that is too near there may be another that is not.
  const ShadowRays both = rays_through({plate(0.1, -9, 9, 9, 4), plate(-9, -9, 9, 9, 3)}, light);
  EXPECT_EQ(both.attenuation(p, points, &more), 1);
  EXPECT_EQ(both.attenuation({0, 0, -1}, points, &more), 0);
  // Points of a light may lie out of its plane.
  const std::vector<LightPoint> nearer{{glm::dvec3(0.5, 0, 1.5)}, {glm::dvec3(0.5, 0, 4.5)}};
  EXPECT_EQ(rays.attenuation(p, nearer), 0.5);
}

TEST(ShadowRays, EachGivenPointHasItsOwnBias) {
  // A caster that rises by 1 m a metre, 0.5 m in front of p: seen within 0.2 of slope, all but the light
  // points without a reach may have hit it behind p.
  const Light light = light_at_origin(RectLight{1, 1});
  const ShadowRays rays =
      rays_through({quad({-3, -3, 1.5F}, {3, -3, 7.5F}, {3, 3, 7.5F}, {-3, 3, 1.5F})}, light);
  std::vector<LightPoint> points(32, LightPoint{glm::dvec3(0.1, 0, 0), {0.2, 0.2}});
  for (const std::size_t n : {3U, 16U, 17U}) points[n].reach = {0, 0};
  const CasterBias bias{0.1, 9};
  EXPECT_DOUBLE_EQ(rays.attenuation({0, 0, 5}, points, &bias), 3.0 / 32);
  EXPECT_EQ(rays.attenuation({0, 0, 5}, points), 1);
}

TEST(ShadowRays, NothingBehindTheEmitterHidesGivenPoints) {
  // A wall through the emitter. Lines from points behind it pass the wall at z = -0.85 and 0.35.
  const Light light = light_at_origin(RectLight{2, 2});
  const ShadowRays rays =
      rays_through({quad({-0.95F, -3, -2}, {-0.95F, 3, -2}, {-0.95F, 3, 0.5F}, {-0.95F, -3, 0.5F})}, light);
  const std::vector<LightPoint> behind{{glm::dvec3(-1, 0, -1)}}, far_behind{{glm::dvec3(-1.4, 0, -1)}};
  EXPECT_EQ(rays.attenuation({1, 0, 5}, behind), 0);
  EXPECT_EQ(rays.attenuation({0.6, 0, 5}, far_behind), 1);
}

TEST(ShadowRays, TwoSidedLightsShineToBothSides) {
  // From behind the middle of each edge the half x > 0 of the light is hidden.
  Scene scene;
  scene.geometry = {plate(0, -50, 50, 50, 1), plate(0, -50, 50, 50, -1)};
  Light light = light_at_origin(RectLight{1, 1});
  // Three quarters of the light come from there, from wherever one looks.
  light.emission = std::make_shared<const EmissionImage>(EmissionImage{2, 1, {1, 3}});
  light.two_sided = true;
  const ShadowRays rays(scene, light, 0.5);
  for (const double z : {2.0, -2.0}) {
    EXPECT_NEAR(rays.attenuation({0, 0, z}, 256, 1), 0.75, 1e-9) << z;
    EXPECT_EQ(rays.attenuation({0.2, 0, z / 4}, 256, 1), 0) << z;
  }
  light.two_sided = false;
  const ShadowRays ahead(scene, light, 0.5);
  EXPECT_NEAR(ahead.attenuation({0, 0, 2}, 256, 1), 0.75, 1e-9);
  EXPECT_EQ(ahead.attenuation({0, 0, -2}, 256, 1), 0);
}

}  // namespace
}  // namespace pdsm
