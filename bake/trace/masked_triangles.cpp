// SPDX-License-Identifier: Apache-2.0
#include "trace/masked_triangles.h"

#include <xxhash.h>

#include <cmath>

namespace pdsm {

MaskedTriangle masked_triangle(const LightSpaceMesh& mesh, std::uint32_t triangle) {
  MaskedTriangle result;
  for (int n = 0; n < 3; ++n) {
    const std::uint32_t corner = mesh.triangles[triangle][n];
    result.corners[static_cast<std::size_t>(n)] = mesh.positions[corner];
    result.places[static_cast<std::size_t>(n)] = glm::dvec2(mesh.mask_places[corner]);
  }
  return result;
}

std::uint64_t triangle_key(const MaskedTriangle& triangle) {
  std::uint64_t key = 0;
  for (const glm::vec3& corner : triangle.corners) {
    const glm::vec3 unsigned_zeros = corner + 0.0F;
    key += XXH3_64bits(&unsigned_zeros, sizeof unsigned_zeros);
  }
  return key;
}

/// The greatest singular value of what a move in the plane is in the mask: a weight of a corner grows along
/// (edge x normal) / |normal|^2.
double mask_texels_per_metre(const MaskedTriangle& triangle, const CutoutMask& mask) {
  const glm::dvec3 a(triangle.corners[0]), e1 = glm::dvec3(triangle.corners[1]) - a,
                                           e2 = glm::dvec3(triangle.corners[2]) - a, n = glm::cross(e1, e2);
  const glm::dvec3 g1 = glm::cross(e2, n) / glm::dot(n, n), g2 = glm::cross(n, e1) / glm::dot(n, n);
  const glm::dvec2 size(mask.width, mask.height);
  const glm::dvec2 m1 = size * (triangle.places[1] - triangle.places[0]),
                   m2 = size * (triangle.places[2] - triangle.places[0]);
  const glm::dvec3 x = m1.x * g1 + m2.x * g2, y = m1.y * g1 + m2.y * g2;
  const double mean = 0.5 * (glm::dot(x, x) + glm::dot(y, y)),
               half_difference = 0.5 * (glm::dot(x, x) - glm::dot(y, y));
  return std::sqrt(mean + std::hypot(half_difference, glm::dot(x, y)));
}

}  // namespace pdsm
