// SPDX-License-Identifier: Apache-2.0
#include "evaluate/smooth_normals.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace pdsm {
namespace {

/// Cosine of 40 degrees: scans stay round, boxes stay sharp.
constexpr float kCreaseCosine = 0.766F;
/// Fans of more triangles than this stay flat, so that the time stays linear.
constexpr std::uint32_t kLargestFan = 256;

/// A number for each vertex that vertices at the same position share.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t v) {
    return std::tuple(positions[v].x, positions[v].y, positions[v].z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> point(positions.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && key(order[i - 1]) != key(order[i])) ++count;
    point[order[i]] = count;
  }
  return point;
}

/// Which triangles touch each welded point: `triangles[first[p]] .. triangles[first[p + 1] - 1]`.
struct Fans {
  std::vector<std::uint32_t> first, triangles;
};

Fans gather_fans(const Mesh& mesh, const std::vector<std::uint32_t>& point) {
  Fans fans;
  fans.first.assign(mesh.positions.size() + 1, 0);
  for (const glm::uvec3& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) ++fans.first[point[t[c]] + 1];
  }
  std::partial_sum(fans.first.begin(), fans.first.end(), fans.first.begin());
  fans.triangles.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    for (int c = 0; c < 3; ++c) fans.triangles[next[point[mesh.triangles[n][c]]]++] = n;
  }
  return fans;
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec3(0);
}

}  // namespace

std::vector<std::array<glm::vec3, 3>> smooth_normals(const Mesh& mesh) {
  const std::vector<std::uint32_t> point = weld(mesh.positions);
  const Fans fans = gather_fans(mesh, point);
  std::vector<glm::vec3> area, unit;  // of each triangle: normal by area, and of length 1
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3& a = mesh.positions[t.x];
    area.push_back(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    unit.push_back(unit_or_zero(area.back()));
  }
  std::vector<std::array<glm::vec3, 3>> normals(mesh.triangles.size());
  for (std::size_t n = 0; n < normals.size(); ++n) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t p = point[mesh.triangles[n][c]];
      glm::vec3 sum = area[n];
      for (std::uint32_t f = fans.first[p]; f < fans.first[p + 1]; ++f) {
        if (fans.first[p + 1] - fans.first[p] > kLargestFan) break;
        const std::uint32_t other = fans.triangles[f];
        if (other != n && glm::dot(unit[other], unit[n]) > kCreaseCosine) sum += area[other];
      }
      normals[n][static_cast<std::size_t>(c)] = unit_or_zero(sum);
    }
  }
  return normals;
}

}  // namespace pdsm
