// SPDX-License-Identifier: Apache-2.0
#include "test_meshes.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

namespace pdsm::test {

Mesh box_mesh(const glm::dvec3& size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(glm::dvec3((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5) *
                                size);
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  mesh.closed = true;
  return mesh;
}

Mesh plate_mesh(double size_x, double size_z) {
  const auto x = static_cast<float>(size_x / 2), z = static_cast<float>(size_z / 2);
  Mesh mesh;
  mesh.positions = {{-x, 0, -z}, {-x, 0, z}, {x, 0, z}, {x, 0, -z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

std::string to_obj(const Mesh& mesh) {
  std::string text;
  for (const glm::vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

Geometry placed(const Mesh& mesh, const glm::dmat4& local_to_world) {
  Geometry geometry;
  geometry.mesh = std::make_shared<Mesh>(mesh);
  geometry.local_to_world = local_to_world;
  return geometry;
}

Geometry placed(const Mesh& mesh, const glm::dvec3& translate) {
  return placed(mesh, glm::translate(glm::dmat4(1.0), translate));
}

double signed_volume(const Geometry& geometry) {
  double volume = 0;
  for (const glm::uvec3& t : geometry.mesh->triangles) {
    glm::dvec3 p[3];
    for (int i = 0; i < 3; ++i) {
      p[i] =
          glm::dvec3(geometry.local_to_world * glm::dvec4(glm::dvec3(geometry.mesh->positions[t[i]]), 1.0));
    }
    volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
  }
  return volume;
}

Light lamp_above(const glm::dvec3& position, double width, double height) {
  Light light;
  light.name = "lamp";
  light.shape = RectLight{width, height};
  light.position = position;
  light.direction = {0, -1, 0};
  light.up = glm::dvec3(0, 0, 1);
  return light;
}

}  // namespace pdsm::test
