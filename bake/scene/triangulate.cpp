// SPDX-License-Identifier: Apache-2.0
// Ear clipping. Paper: Meisters, "Polygons Have Ears", 1975.
#include "scene/triangulate.h"

#include <cmath>

namespace pdsm {
namespace {

// Ears take cubic time at worst; polygons with more corners are taken for convex.
constexpr std::size_t kMaxClippedCorners = 256;

struct Corner {
  std::uint32_t index = 0;
  glm::dvec2 place{0};  ///< in the polygon's plane, counter-clockwise
};

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners without the axis along which the polygon is seen best.
std::vector<Corner> flatten(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon) {
  glm::dvec3 normal(0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    normal += glm::cross(glm::dvec3(positions[polygon[i]]),
                         glm::dvec3(positions[polygon[(i + 1) % polygon.size()]]));
  }
  const glm::dvec3 size = glm::abs(normal);
  const int dropped = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  std::vector<Corner> corners;
  corners.reserve(polygon.size());
  for (const std::uint32_t index : polygon) {
    const glm::dvec3 p(positions[index]);
    // Swapped axes turn a clockwise polygon round.
    corners.push_back({index, normal[dropped] < 0 ? glm::dvec2(p[v], p[u]) : glm::dvec2(p[u], p[v])});
  }
  return corners;
}

/// Whether corner i and its neighbours make a triangle inside the polygon.
bool is_ear(std::span<const Corner> corners, std::size_t i) {
  const std::size_t count = corners.size();
  const glm::dvec2 &a = corners[(i + count - 1) % count].place, &b = corners[i].place,
                   &c = corners[(i + 1) % count].place;
  if (!(cross(a, b, c) > 0)) return false;
  for (const Corner& other : corners) {
    const glm::dvec2& p = other.place;
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles) {
  std::vector<Corner> corners;
  std::vector<std::uint32_t> rest;
  std::span<const std::uint32_t> left = polygon;
  if (polygon.size() > 3 && polygon.size() <= kMaxClippedCorners) {
    corners = flatten(positions, polygon);
    for (std::size_t i = 0; corners.size() > 3 && i < corners.size();) {
      if (!is_ear(corners, i)) {
        ++i;
        continue;
      }
      const std::size_t count = corners.size();
      triangles.emplace_back(corners[(i + count - 1) % count].index, corners[i].index,
                             corners[(i + 1) % count].index);
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
    for (const Corner& corner : corners) rest.push_back(corner.index);
    left = rest;
  }
  // One triangle is left, or what has no ears because it is flat or crosses itself.
  for (std::size_t i = 2; i < left.size(); ++i) triangles.emplace_back(left[0], left[i - 1], left[i]);
}

}  // namespace pdsm
