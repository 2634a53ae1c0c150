// SPDX-License-Identifier: Apache-2.0
#include "support/scenes.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace pdsm::test {
namespace {

Light light_at_origin() {
  Light light;
  light.name = "test";
  light.position = glm::dvec3(0);
  light.direction = {0, 0, 1};
  light.up = glm::dvec3(0, 1, 0);
  return light;
}

void add_triangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& p : {a, b, c}) mesh.positions.emplace_back(p);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void add_sphere_face(Mesh& mesh, const glm::dvec3& center, double r, const glm::dvec3& a, const glm::dvec3& b,
                     const glm::dvec3& c, int levels) {
  if (levels == 0) {
    add_triangle(mesh, center + r * a, center + r * b, center + r * c);
    return;
  }
  const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
  add_sphere_face(mesh, center, r, a, ab, ca, levels - 1);
  add_sphere_face(mesh, center, r, ab, b, bc, levels - 1);
  add_sphere_face(mesh, center, r, ca, bc, c, levels - 1);
  add_sphere_face(mesh, center, r, ab, bc, ca, levels - 1);
}

}  // namespace

Light rect_light(double width, double height) {
  Light light = light_at_origin();
  light.shape = RectLight{width, height};
  return light;
}

Light disk_light(double radius) {
  Light light = light_at_origin();
  light.shape = DiskLight{radius};
  return light;
}

Light distant_light(double angle) {
  Light light = light_at_origin();
  light.shape = DistantLight{angle};
  return light;
}

void set_view(Light& light, double x, double y, double near_depth, double far_depth) {
  light.window = {-x, -y, x, y};
  light.near_depth = near_depth;
  light.far_depth = far_depth;
}

Mesh quad_mesh(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  Mesh mesh;
  for (const glm::dvec3& p : {a, b, c, d}) mesh.positions.emplace_back(p);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh plate_mesh(const Plate& p) {
  return quad_mesh({p.x0, p.y0, p.z}, {p.x1, p.y0, p.z}, {p.x1, p.y1, p.z}, {p.x0, p.y1, p.z});
}

Mesh box_mesh(const glm::dvec3& low, const glm::dvec3& high) {
  Mesh mesh;
  for (int n = 0; n < 8; ++n) {
    mesh.positions.emplace_back((n & 1) != 0 ? high.x : low.x, (n & 2) != 0 ? high.y : low.y,
                                (n & 4) != 0 ? high.z : low.z);
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  mesh.closed = true;
  return mesh;
}

Mesh sphere_mesh(const glm::dvec3& center, double r, int levels) {
  Mesh mesh;
  for (int octant = 0; octant < 8; ++octant) {
    const glm::dvec3 x((octant & 1) != 0 ? -1 : 1, 0, 0), y(0, (octant & 2) != 0 ? -1 : 1, 0),
        z(0, 0, (octant & 4) != 0 ? -1 : 1);
    const bool flipped = x.x * y.y * z.z < 0;
    add_sphere_face(mesh, center, r, x, flipped ? z : y, flipped ? y : z, levels);
  }
  mesh.closed = true;
  return mesh;
}

double inscribed_radius(const Mesh& sphere, const glm::dvec3& center) {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : sphere.triangles) {
    const glm::dvec3 a(sphere.positions[t.x]), b(sphere.positions[t.y]), c(sphere.positions[t.z]);
    least = std::min(least, std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), a - center)));
  }
  return least;
}

void add(Scene& scene, Mesh mesh, Roles roles) {
  Geometry geometry;
  geometry.name = "geometry " + std::to_string(scene.geometry.size());
  geometry.mesh = std::make_shared<const Mesh>(std::move(mesh));
  geometry.casts = roles != Roles::receiver;
  geometry.receives = roles != Roles::caster;
  scene.geometry.push_back(std::move(geometry));
}

void add(Scene& scene, const Plate& plate, Roles roles) {
  add(scene, plate_mesh(plate), roles);
}

}  // namespace pdsm::test
