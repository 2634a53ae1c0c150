// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_cleanup.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace pdsm {
namespace {

// Squares of larger coordinates, and products of those, leave the range of float in the ray tracer.
constexpr float kMaxCoordinate = 1e15F;

bool is_usable(const glm::vec3& p) {
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
         std::abs(p.z) <= kMaxCoordinate;
}

bool is_usable(const Mesh& mesh, std::uint32_t corner) {
  if (!is_usable(mesh.positions[corner])) return false;
  if (!mesh.mask) return true;
  const glm::vec2& place = mesh.mask_places[corner];
  return std::isfinite(place.x) && std::isfinite(place.y);
}

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::cross(b - a, c - a) != glm::dvec3(0);
}

/// The triangles that can be used, still with all positions.
Mesh keep_usable(const Mesh& raw, LeftOut& left_out) {
  Mesh mesh;
  mesh.positions = raw.positions;
  mesh.mask = raw.mask;
  mesh.mask_places = raw.mask_places;
  mesh.triangles.reserve(raw.triangles.size());
  const std::size_t count = mesh.positions.size();
  for (const glm::uvec3& t : raw.triangles) {
    if (t.x >= count || t.y >= count || t.z >= count) {
      ++left_out.bad_index;
    } else if (!is_usable(mesh, t.x) || !is_usable(mesh, t.y) || !is_usable(mesh, t.z)) {
      ++left_out.not_finite;
    } else {
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace

std::string describe(const LeftOut& left_out) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count == 0) return;
    const char* noun = !text.empty() ? "" : count == 1 ? "triangle " : "triangles ";
    text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, noun, what);
  };
  add(left_out.bad_index, "with corners out of range");
  add(left_out.not_finite, "with NaN or infinite coordinates");
  add(left_out.no_area, "without area");
  return text.empty() ? text : text + " left out";
}

Mesh clean_mesh(const Mesh& raw, LeftOut& left_out) {
  Mesh mesh = weld(keep_usable(raw, left_out));
  const auto erase = [&](auto&& bad) { left_out.no_area += std::erase_if(mesh.triangles, bad); };
  erase([](const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; });
  // A sliver without area joins its neighbours, so it takes part in this and is left out after.
  mesh.closed = is_closed(mesh);
  const auto& p = mesh.positions;
  erase([&](const glm::uvec3& t) { return !has_area(p[t.x], p[t.y], p[t.z]); });
  return mesh;
}

}  // namespace pdsm
