// SPDX-License-Identifier: Apache-2.0
#include "surface_mesh.h"

#include <cmath>
#include <numbers>

#include "evaluate/smooth_normals.h"
#include "truth/world_scene.h"

namespace pdsm {
namespace {

/// Vertices of one position, chained: corners that agree in their normal share a vertex.
class VertexPool {
 public:
  explicit VertexPool(std::size_t positions) : newest_(positions, kNone) {}

  std::uint32_t add(std::uint32_t position, const SurfaceVertex& vertex,
                    std::vector<SurfaceVertex>& vertices) {
    for (std::uint32_t v = newest_[position]; v != kNone; v = older_[v]) {
      if (vertices[v] == vertex) return v;
    }
    const auto added = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    older_.push_back(newest_[position]);
    newest_[position] = added;
    return added;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> newest_, older_;
};

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x + v.y + v.z);
}

/// Where the knot's centre line is at `t` (radians): twice around the axis, three times through the hole.
glm::vec3 knot_line(float t) {
  const float ring = 0.68F + 0.3F * std::cos(1.5F * t);
  return {ring * std::cos(t), 0.3F * std::sin(1.5F * t), ring * std::sin(t)};
}

}  // namespace

std::uint32_t pack_normal(const glm::vec3& normal) {
  std::uint32_t packed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto code = static_cast<std::int32_t>(std::lround(511 * normal[axis]));
    packed |= (static_cast<std::uint32_t>(code) & 0x3FFU) << (10 * axis);
  }
  return packed;
}

SurfaceMesh make_surface_mesh(const Geometry& geometry, const glm::dvec3& origin) {
  const Mesh& mesh = *geometry.mesh;
  const auto normals = smooth_normals(mesh);
  const glm::dmat3 normal_to_world = glm::transpose(glm::inverse(glm::dmat3(geometry.local_to_world)));
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.positions.size());
  for (const glm::vec3& position : mesh.positions) {
    positions.push_back(glm::vec3(to_world(geometry, position) - origin));
  }
  SurfaceMesh surface;
  VertexPool pool(positions.size());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const glm::uvec3& triangle = mesh.triangles[n];
    if (!is_finite(positions[triangle.x] + positions[triangle.y] + positions[triangle.z])) continue;
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 normal = normal_to_world * glm::dvec3(normals[n][static_cast<std::size_t>(c)]);
      const double length = glm::length(normal);
      const glm::vec3 unit = length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
      surface.indices.push_back(
          pool.add(triangle[c], {positions[triangle[c]], pack_normal(unit)}, surface.vertices));
    }
  }
  return surface;
}

SurfaceMesh make_knot() {
  constexpr std::uint32_t kAlong = 240, kAround = 24;
  constexpr float kTube = 0.19F, kTurn = 2 * std::numbers::pi_v<float>;
  SurfaceMesh knot;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    const float t = 2 * kTurn * static_cast<float>(i) / kAlong;
    const glm::vec3 centre = knot_line(t);
    const glm::vec3 along = glm::normalize(knot_line(t + 0.01F) - knot_line(t - 0.01F));
    const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(side, along);
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const float angle = kTurn * static_cast<float>(j) / kAround;
      const glm::vec3 normal = std::cos(angle) * side + std::sin(angle) * up;
      knot.vertices.push_back({centre + kTube * normal, pack_normal(normal)});
      const std::uint32_t next_i = (i + 1) % kAlong, next_j = (j + 1) % kAround;
      const std::uint32_t a = i * kAround + j, b = next_i * kAround + j;
      const std::uint32_t c = next_i * kAround + next_j, d = i * kAround + next_j;
      knot.indices.insert(knot.indices.end(), {a, b, c, a, c, d});
    }
  }
  return knot;
}

}  // namespace pdsm
