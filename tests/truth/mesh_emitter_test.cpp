// SPDX-License-Identifier: Apache-2.0
// Mesh lights in the truth: what is seen of them, and the baker's model of them.
#include "truth/mesh_emitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plates.h"
#include "truth/light_points.h"
#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

constexpr double kRadius = 0.2;

/// A closed sphere of many triangles.
std::shared_ptr<const Mesh> ball(double radius) {
  constexpr std::uint32_t kRings = 64, kAround = 128;
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i <= kRings; ++i)
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double polar = std::numbers::pi * i / kRings, angle = 2 * std::numbers::pi * j / kAround;
      const double ring = i == 0 || i == kRings ? 0 : std::sin(polar);
      positions.emplace_back(radius * ring * std::cos(angle), radius * ring * std::sin(angle),
                             radius * std::cos(polar));
    }
  for (std::uint32_t i = 0; i < kRings; ++i)
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const std::uint32_t a = i * kAround + j, b = i * kAround + (j + 1) % kAround;
      if (i > 0) triangles.emplace_back(a, a + kAround, b);
      if (i + 1 < kRings) triangles.emplace_back(b, a + kAround, b + kAround);
    }
  return geometry_of(std::move(positions), std::move(triangles)).mesh;
}

Light mesh_light(std::shared_ptr<const Mesh> mesh) {
  return light_at_origin(MeshLight{std::move(mesh)});
}

/// Half of what is drawn counts nothing or little: what remains errs as so many draws apart.
constexpr std::uint32_t kDraws = 1 << 16;
double slack() {
  return std::sqrt(std::log(2e6) / 2 / (kDraws / 4.0));
}

TEST(MeshEmitter, ASphereOfTrianglesIsOneThatIsSeen) {
  const auto mesh = ball(kRadius);
  ASSERT_TRUE(mesh->closed);
  Scene scene;
  scene.geometry = {half_plane(0.3, 0.03, 0.4)};
  const ShadowRays of_mesh(scene, mesh_light(mesh), 0.1),
      of_sphere(scene, light_at_origin(SphereLight{kRadius}), 0.1);
  for (const glm::dvec3& p :
       {glm::dvec3(0, 0, 0.6), {0.05, 0.02, 0.8}, {-0.1, 0, 1}, {0.1, 0.1, 1.5}, {0, 0, -1}}) {
    EXPECT_NEAR(of_mesh.attenuation(p, kDraws, 1), of_sphere.attenuation(p, kDraws, 2), slack() + 0.004)
        << p.x;
    EXPECT_NEAR(of_mesh.model_rgb(p, kDraws, 1)[0], of_sphere.model_rgb(p, kDraws, 2)[0], slack() + 0.004)
        << p.x;
  }
  EXPECT_EQ(of_mesh.attenuation({0.05, 0, 0.05}, 256, 1), 0);
}

TEST(MeshEmitter, WhatLiesBehindTheRestIsNotSeen) {
  // Two sheets, one behind the other, and a plate that hides one half of each from afar.
  const auto sheets = geometry_of({{-1, -1, 0.5F},
                                   {1, -1, 0.5F},
                                   {1, 1, 0.5F},
                                   {-1, 1, 0.5F},
                                   {0, -1, -0.5F},
                                   {3, -1, -0.5F},
                                   {3, 1, -0.5F},
                                   {0, 1, -0.5F}},
                                  {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}})
                          .mesh;
  const MeshEmitter emitter(*sheets);
  const JitteredGrid grid(4096);
  const glm::dvec3 far(0, 0, 1000);
  double front = 0, back = 0;
  for (std::uint32_t n = 0; n < 4096; ++n) {
    const MeshEmitter::Seen seen = emitter.seen(far, grid.point(n, 1));
    (seen.point.z > 0 ? front : back) += seen.weight;
    const bool is_behind = seen.point.z < 0 && seen.point.x < 0.99;
    EXPECT_TRUE(!is_behind || seen.weight == 0) << seen.point.x;
  }
  // Of the back sheet, 6 m2, the part from x = 1 is seen: as much as of the front one.
  EXPECT_NEAR(back / front, 1, 0.05);
  // From the other side all of the back one, and what it does not hide of the other.
  EXPECT_GT(emitter.seen({0, 0, -1000}, {0.1, 0.5}).weight + emitter.seen({0, 0, -1000}, {0.9, 0.5}).weight,
            0);
}

TEST(MeshEmitter, NearPartsCountByTheirSolidAngle) {
  // A square of edge 2 seen from 0.25 before it, what lies beyond x = 0.2 hidden.
  const auto sheet =
      geometry_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}).mesh;
  const glm::dvec3 p(0.6, 0, 0.25);
  Scene scene;
  scene.geometry = {half_plane(0, 0.36, 0.1)};
  const double edge = 0.6 + (0.36 - 0.6) * 0.25 / 0.15;
  double hidden = 0, all = 0;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 400; ++j) {
      const glm::dvec3 q((i + 0.5) / 200 - 1, (j + 0.5) / 200 - 1, 0);
      const double squared = glm::dot(p - q, p - q), weight = 0.25 / (squared * std::sqrt(squared));
      all += weight;
      hidden += q.x > edge ? weight : 0;
    }
  const ShadowRays rays(scene, mesh_light(sheet), 0.1);
  // Straight ahead a part weighs 16, and more than 0.8 on the average: as so many fewer draws.
  EXPECT_GT(all / (400 * 400), 0.8);
  EXPECT_NEAR(rays.attenuation(p, kDraws, 1), hidden / all, std::sqrt(16 / 0.8 / 4) * slack());
  // The model counts areas.
  EXPECT_NEAR(rays.model_rgb(p, kDraws, 1)[0], (1 - edge) / 2, slack());
}

TEST(MeshEmitter, SurfacePointsAreUniform) {
  const auto two =
      geometry_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 1}, {0, 3, 1}}, {{0, 1, 2}, {3, 4, 5}})
          .mesh;
  constexpr int kSide = 128;
  int upper = 0, corner = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::dvec3 p =
        mesh_surface_point(*two, {(i % kSide + 0.5) / kSide, (static_cast<double>(i / kSide) + 0.5) / kSide});
    upper += p.z > 0.5 ? 1 : 0;
    corner += p.z > 0.5 && p.x / 2 + p.y / 3 < 0.5 ? 1 : 0;
    ASSERT_LE(p.z > 0.5 ? p.x / 2 + p.y / 3 : p.x + p.y, 1 + 1e-6);
  }
  // Areas 1/2 and 3; a quarter of the latter; each border crosses at most two cells a row.
  EXPECT_NEAR(upper, 6.0 / 7 * kSide * kSide, 2 * kSide);
  EXPECT_NEAR(corner, 1.5 / 7 * kSide * kSide, 4 * kSide);
}

}  // namespace
}  // namespace pdsm
