// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "light/convex_clip.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// One triangle in light space and where it lies with respect to a region.
struct LightTriangle {
  std::array<glm::dvec3, 3> corners;
  glm::uvec3 vertices;            ///< of the mesh, that the corners are
  std::uint32_t outside_all = 0;  ///< half-spaces that no corner is in: the triangle lies outside
  std::uint32_t outside_any = 0;  ///< half-spaces that some corner is not in: 0 when it lies inside
};

/// Moves geometry to a light's space, in double. The light's position is subtracted before anything is
/// rotated, so that a scene far from the world's origin keeps its digits.
class LightSpace {
 public:
  explicit LightSpace(const Light& light);

  /// Light space to axes parallel to the world's, origin still at the light's centre.
  [[nodiscard]] glm::dvec3 to_world_axes(const glm::dvec3& p) const { return p * rotation_; }
  [[nodiscard]] glm::dvec3 from_world_axes(const glm::dvec3& p) const { return rotation_ * p; }

  /// Calls visit(const LightTriangle&) for each triangle whose coordinates are finite, in order.
  template <typename Visit>
  void visit_triangles(const Geometry& geometry, const ConvexRegion& region, Visit&& visit) const;

 private:
  // More than any ConvexRegion gives: a corner that is not finite.
  static constexpr std::uint8_t kNotFinite = 0x80;

  glm::dmat3 rotation_;
  glm::dvec3 position_;
};

template <typename Visit>
void LightSpace::visit_triangles(const Geometry& geometry, const ConvexRegion& region, Visit&& visit) const {
  const glm::dmat3 linear = rotation_ * glm::dmat3(geometry.local_to_world);
  const glm::dvec3 offset = rotation_ * (glm::dvec3(geometry.local_to_world[3]) - position_);
  const std::size_t count = geometry.mesh->positions.size();
  std::vector<glm::dvec3> positions(count);
  std::vector<std::uint8_t> outside(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 p = linear * glm::dvec3(geometry.mesh->positions[i]) + offset;
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    positions[i] = p;
    outside[i] = finite ? static_cast<std::uint8_t>(region.outside_bits(p)) : kNotFinite;
  }
  for (const glm::uvec3& t : geometry.mesh->triangles) {
    if (t.x >= count || t.y >= count || t.z >= count) continue;
    const std::uint32_t a = outside[t.x], b = outside[t.y], c = outside[t.z];
    if (((a | b | c) & kNotFinite) != 0) continue;
    visit(LightTriangle{{positions[t.x], positions[t.y], positions[t.z]}, t, a & b & c, a | b | c});
  }
}

}  // namespace pdsm
