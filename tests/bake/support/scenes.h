// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "pdsm/bake/scene.h"

/// Scenes made in memory. The test light sits at the world's origin and looks along +z with x and y as its
/// axes, so that world space is light space and z is depth.
namespace pdsm::test {

/// An axis-aligned rectangle at depth z.
struct Plate {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0, z = 0;
};

/// Far larger than anything a light sees: the edge of a plate that reaches here is out of sight.
inline constexpr double kWide = 1000;

[[nodiscard]] Light rect_light(double width, double height);
[[nodiscard]] Light disk_light(double radius);
/// `angle`: degrees. Its space begins at the origin, too.
[[nodiscard]] Light distant_light(double angle);
/// Sets window [-x, -y, x, y] (tangents), near and far, so that a test knows its view.
void set_view(Light& light, double x, double y, double near_depth, double far_depth);

[[nodiscard]] Mesh quad_mesh(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                             const glm::dvec3& d);
[[nodiscard]] Mesh plate_mesh(const Plate& plate);
/// A closed box, outward normals.
[[nodiscard]] Mesh box_mesh(const glm::dvec3& low, const glm::dvec3& high);
/// A closed sphere inscribed into radius r: an octahedron, each face cut into 4^levels.
[[nodiscard]] Mesh sphere_mesh(const glm::dvec3& center, double r, int levels);
/// Distance of the nearest face of sphere_mesh from its centre.
[[nodiscard]] double inscribed_radius(const Mesh& sphere, const glm::dvec3& center);

enum class Roles { both, caster, receiver };
void add(Scene& scene, Mesh mesh, Roles roles = Roles::both);
void add(Scene& scene, const Plate& plate, Roles roles = Roles::both);

}  // namespace pdsm::test
