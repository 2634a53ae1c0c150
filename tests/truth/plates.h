// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene.h"

/// Scenes of which the truth is known, made in light space: the light at the origin shines along +z, and its
/// x and y are the world's.
namespace pdsm {

/// A bake of a second.
inline BakeOptions small_options() {
  BakeOptions options;
  options.samples = 64;
  options.width = 48;
  options.height = 40;
  options.threads = 2;
  return options;
}

inline Light light_at_origin(LightShape shape) {
  Light light;
  light.name = "key";
  light.shape = shape;
  light.position = {0, 0, 0};
  light.direction = {0, 0, 1};
  light.up = {0, 1, 0};
  return light;
}

inline Geometry geometry_of(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = std::move(positions);
  mesh->triangles = std::move(triangles);
  mesh->closed = is_closed(*mesh);
  Geometry geometry;
  geometry.name = "test";
  geometry.mesh = std::move(mesh);
  return geometry;
}

/// A quad with the given corners in order.
inline Geometry quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  return geometry_of({a, b, c, d}, {{0, 1, 2}, {0, 2, 3}});
}

/// A rectangle parallel to the light at depth z.
inline Geometry plate(double x0, double y0, double x1, double y1, double z) {
  return quad(glm::vec3(x0, y0, z), glm::vec3(x1, y0, z), glm::vec3(x1, y1, z), glm::vec3(x0, y1, z));
}

/// The half-plane n . (x, y) > a at depth z, n = (cos angle, sin angle); `reach` stands for infinity.
inline Geometry half_plane(double angle, double a, double z, double reach = 200) {
  const glm::dvec2 n(std::cos(angle), std::sin(angle)), along(-n.y, n.x);
  const auto corner = [&](double across, double beside) {
    return glm::vec3(glm::dvec3(across * n + beside * along, z));
  };
  return quad(corner(a, -reach), corner(a + reach, -reach), corner(a + reach, reach), corner(a, reach));
}

/// The geometry mirrored at x = 0, its triangles turned over as an import does it.
inline Geometry mirrored(Geometry geometry) {
  auto mesh = std::make_shared<Mesh>(*geometry.mesh);
  for (glm::uvec3& t : mesh->triangles) std::swap(t.y, t.z);
  geometry.mesh = mesh;
  geometry.local_to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1)) *
                            geometry.local_to_world;
  return geometry;
}

/// A closed sphere of `rings` x 2 rings quads.
inline Geometry sphere(const glm::dvec3& centre, double radius, std::uint32_t rings) {
  const double pi = std::acos(-1.0);
  const std::uint32_t around = 2 * rings;
  std::vector<glm::vec3> positions;
  for (std::uint32_t r = 0; r <= rings; ++r) {
    for (std::uint32_t s = 0; s < around; ++s) {
      const double polar = pi * r / rings, turn = 2 * pi * s / around;
      const double beside = r == rings ? 0 : std::sin(polar);  // each pole is one point exactly
      const glm::dvec3 unit(beside * std::cos(turn), beside * std::sin(turn), std::cos(polar));
      positions.emplace_back(centre + radius * unit);
    }
  }
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t s = 0; s < around; ++s) {
      const std::uint32_t a = r * around + s, b = r * around + (s + 1) % around;
      if (r + 1 < rings) triangles.emplace_back(a, a + around, b + around);
      if (r > 0) triangles.emplace_back(a, b + around, b);
    }
  }
  return geometry_of(std::move(positions), std::move(triangles));
}

}  // namespace pdsm
