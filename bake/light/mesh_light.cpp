// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "pdsm/bake/scene.h"
#include "pdsm/format/error.h"

namespace pdsm {

void set_emitter(std::span<const Geometry> surfaces, Light& light) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low(kInfinity), high(-kInfinity);
  const auto visit_corners = [&](const Geometry& surface, auto&& visit) {
    for (const glm::vec3& p : surface.mesh->positions)
      visit(glm::dvec3(surface.local_to_world * glm::dvec4(glm::dvec3(p), 1.0)));
  };
  for (const Geometry& surface : surfaces)
    visit_corners(surface, [&](const glm::dvec3& p) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    });
  light.position = low.x <= high.x ? (low + high) / 2.0 : glm::dvec3(0);
  const auto r = light_frame(light).rotation;
  const glm::dmat3 to_light(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]);
  auto mesh = std::make_shared<Mesh>();
  for (const Geometry& surface : surfaces) {
    const auto first = static_cast<std::uint32_t>(mesh->positions.size());
    visit_corners(
        surface, [&](const glm::dvec3& p) { mesh->positions.emplace_back(to_light * (p - light.position)); });
    for (const glm::uvec3& t : surface.mesh->triangles) mesh->triangles.push_back(t + first);
  }
  mesh->closed = is_closed(*mesh);
  light.shape = MeshLight{std::move(mesh)};
}

void check_mesh_light(const Light& light) {
  const auto* shape = std::get_if<MeshLight>(&light.shape);
  if (shape == nullptr) return;
  const auto refuse = [&](const char* reason) { throw Error(Failure::input, light.name + ".mesh", reason); };
  if (!shape->mesh) refuse("is missing");
  const Mesh& mesh = *shape->mesh;
  const auto is_finite = [](const glm::vec3& p) { return std::isfinite(p.x + p.y + p.z); };
  if (!std::ranges::all_of(mesh.positions, is_finite)) refuse("must have finite positions");
  const std::size_t count = mesh.positions.size();
  const auto is_index = [count](const glm::uvec3& t) { return std::max({t.x, t.y, t.z}) < count; };
  if (!std::ranges::all_of(mesh.triangles, is_index)) refuse("must have indices of its positions");
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    area += glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
  }
  if (!(area > 0)) refuse("has no area");
}

}  // namespace pdsm
