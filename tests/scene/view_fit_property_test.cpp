// SPDX-License-Identifier: Apache-2.0
// Whatever the scene: what is darkened lies in the fitted window, and what darkens it lies behind near.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "pdsm/bake/view_fit.h"
#include "test_meshes.h"

namespace pdsm::test {
namespace {

/// Random numbers that are the same with every library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  glm::dvec3 vector(double low, double high) {
    const double x = (*this)(low, high), y = (*this)(low, high);
    return {x, y, (*this)(low, high)};
  }

 private:
  std::mt19937 engine_;
};

struct Triangle {
  glm::dvec3 corners[3];
  bool casts, receives, closed;
};

/// The depth, as a share of the way from `from` to `to`, at which the triangle is crossed.
std::optional<double> crossing(const Triangle& triangle, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 e1 = triangle.corners[1] - triangle.corners[0],
                   e2 = triangle.corners[2] - triangle.corners[0];
  const glm::dvec3 d = to - from, p = glm::cross(d, e2);
  const double determinant = glm::dot(e1, p);
  if (std::abs(determinant) < 1e-12) return std::nullopt;
  const glm::dvec3 s = from - triangle.corners[0], q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return glm::dot(e2, q) / determinant;
}

/// Boxes about and above a tilted floor, open or closed, some of which cast or receive only.
Scene random_scene(Random& random) {
  Scene scene;
  glm::dmat4 tilt = glm::rotate(glm::dmat4(1.0), random(-0.5, 0.5), glm::dvec3(1, 0, 0));
  scene.geometry.push_back(placed(plate_mesh(random(2, 30), random(2, 30)), tilt));
  const int boxes = static_cast<int>(random(0, 5));
  for (int i = 0; i < boxes; ++i) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), random.vector(-3, 3));
    m = glm::rotate(m, random(0, 6), glm::normalize(random.vector(-1, 1) + glm::dvec3(0, 0, 1.5)));
    Mesh mesh = box_mesh(glm::dvec3(0.1) + random.vector(0, 2));
    mesh.closed = random(0, 1) < 0.5;
    scene.geometry.push_back(placed(mesh, m));
    scene.geometry.back().casts = random(0, 1) < 0.8;
    scene.geometry.back().receives = random(0, 1) < 0.8;
  }
  return scene;
}

std::vector<Triangle> light_space_triangles(const Scene& scene, const RigidTransform& frame) {
  std::vector<Triangle> triangles;
  for (const Geometry& geometry : scene.geometry) {
    for (const glm::uvec3& t : geometry.mesh->triangles) {
      Triangle triangle{{}, geometry.casts, geometry.receives, geometry.mesh->closed};
      for (int i = 0; i < 3; ++i) {
        const glm::dvec4 local(glm::dvec3(geometry.mesh->positions[t[i]]), 1.0);
        triangle.corners[i] = apply(frame, glm::dvec3(geometry.local_to_world * local));
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// A point of a triangle, drawn at random.
struct SurfacePoint {
  const Triangle& triangle;
  glm::dvec3 p;

  /// Whether light that comes along `to_light` arrives there on a receiver.
  [[nodiscard]] bool receives(const glm::dvec3& to_light) const {
    const auto& c = triangle.corners;
    return triangle.receives &&
           (!triangle.closed || glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), to_light) > 0);
  }
};

SurfacePoint random_surface_point(const std::vector<Triangle>& triangles, Random& random) {
  const auto index = static_cast<std::size_t>(random(0, static_cast<double>(triangles.size())));
  const Triangle& t = triangles[index];
  const double a = std::sqrt(random(0, 1)), b = random(0, 1);
  return {t, t.corners[0] * (1 - a) + t.corners[1] * (a * (1 - b)) + t.corners[2] * (a * b)};
}

/// A point of a receiver that faces the point s of the light and lies in front of it, within 120 degrees.
std::optional<glm::dvec3> random_receiver_point(const std::vector<Triangle>& triangles, const glm::dvec3& s,
                                                Random& random) {
  const SurfacePoint point = random_surface_point(triangles, random);
  const glm::dvec3& p = point.p;
  const double limit = std::numbers::sqrt3 * p.z;
  const bool in_front = p.z > 0 && std::abs(p.x) <= limit && std::abs(p.y) <= limit;
  return point.receives(s - p) && in_front ? std::optional(p) : std::nullopt;
}

TEST(ViewFitProperty, ShadowsAreInTheWindowAndBlockersBehindNear) {
  Random random(20240607);
  int darkened = 0, narrowed = 0;
  for (int round = 0; round < 400; ++round) {
    const Scene scene = random_scene(random);
    Light light = lamp_above({random(-2, 2), random(2, 8), random(-2, 2)}, random(0, 3), random(0, 3));
    light.direction = glm::dvec3(random(-0.8, 0.8), -1, random(-0.8, 0.8));
    const FittedView fitted = fit_view(scene, light, 1, 1);
    const auto& w = fitted.view.window;
    const std::vector<Triangle> triangles = light_space_triangles(scene, fitted.view.world_to_view);
    const auto h = half_extents(light);
    narrowed += w[2] - w[0] < 2 ? 1 : 0;
    for (int ray = 0; ray < 200; ++ray) {
      const glm::dvec3 s(random(-h[0], h[0]), random(-h[1], h[1]), 0);
      const std::optional<glm::dvec3> p = random_receiver_point(triangles, s, random);
      if (!p) continue;
      for (const Triangle& caster : triangles) {
        const std::optional<double> share = caster.casts ? crossing(caster, s, *p) : std::nullopt;
        // What touches the point, or lies in the emitter's plane, does not block.
        if (!share || *share > 1 - 2e-3 || *share * p->z < 2e-4 * fitted.view.far_depth) continue;
        if (*share <= 0) continue;
        ++darkened;
        const double x = p->x / p->z, y = p->y / p->z;
        ASSERT_TRUE(x >= w[0] && x <= w[2] && y >= w[1] && y <= w[3])
            << "round " << round << ": " << x << ", " << y << " not in " << w[0] << " " << w[1] << " " << w[2]
            << " " << w[3];
        ASSERT_GE(*share * p->z, fitted.view.near_depth) << "round " << round;
        ASSERT_LE(p->z, fitted.view.far_depth) << "round " << round;
        ASSERT_FALSE(fitted.nothing_casts) << "round " << round;
      }
    }
  }
  // The scenes are worth it: many shadows, and many windows smaller than everything.
  EXPECT_GT(darkened, 5000);
  EXPECT_GT(narrowed, 50);
}

TEST(ViewFitProperty, ShadowsOfTheSunAreInTheWindowToo) {
  Random random(20240608);
  int darkened = 0, narrowed = 0;
  for (int round = 0; round < 400; ++round) {
    Scene scene = random_scene(random);
    // A floor that casts on boxes below it has a shadow as large as itself.
    scene.geometry[0].casts = round % 2 == 0;
    Light light;
    light.shape = DistantLight{random(0, 1) < 0.3 ? 0.53 : random(0, 90)};
    light.direction = random.vector(-1, 1) - glm::dvec3(0, 0.5, 0);
    place_distant_light(scene, light);
    const FittedView fitted = fit_view(scene, light, 1, 1);
    const auto& w = fitted.view.window;
    const std::vector<Triangle> triangles = light_space_triangles(scene, fitted.view.world_to_view);
    const double h = half_extents(light)[0];
    narrowed += fitted.receivers_outside > 0.1 ? 1 : 0;
    for (int ray = 0; ray < 200; ++ray) {
      const double angle = random(0, 2 * std::numbers::pi), radius = random(0, h);
      const glm::dvec3 d(radius * std::cos(angle), radius * std::sin(angle), 1);
      const SurfacePoint point = random_surface_point(triangles, random);
      const glm::dvec3& p = point.p;
      if (!point.receives(-d)) continue;
      for (const Triangle& caster : triangles) {
        const std::optional<double> share = caster.casts ? crossing(caster, p - p.z * d, p) : std::nullopt;
        // What touches the point does not block.
        if (!share || *share > 1 - 2e-3) continue;
        ++darkened;
        ASSERT_TRUE(p.x >= w[0] && p.x <= w[2] && p.y >= w[1] && p.y <= w[3])
            << "round " << round << ": " << p.x << ", " << p.y << " not in " << w[0] << " " << w[1] << " "
            << w[2] << " " << w[3];
        ASSERT_GT(*share, 0) << "round " << round;
        ASSERT_GE(*share * p.z, fitted.view.near_depth) << "round " << round;
        ASSERT_LE(p.z, fitted.view.far_depth) << "round " << round;
        ASSERT_FALSE(fitted.nothing_casts) << "round " << round;
      }
    }
  }
  EXPECT_GT(darkened, 5000);
  EXPECT_GT(narrowed, 50);
}

}  // namespace
}  // namespace pdsm::test
