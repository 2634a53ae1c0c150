// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

/// Curves of a scene (scene.h): hair, fur, grass, wires. Plain data, as meshes are; read from hair files by
/// read_scene(), or filled by a host program.
namespace pdsm {

/// Chains of straight segments that share their points.
struct Strands {
  std::vector<glm::vec4> points;        ///< x, y, z, and radius there: finite, above 0
  std::vector<std::uint32_t> segments;  ///< first point of each; the next one ends it
};

/// What is across a segment.
enum class CurveShape : std::uint8_t {
  round,  ///< a tube: a cone between spheres of the radii at both ends
  flat    ///< a ribbon that always faces the ray that looks at it
};

/// One placed set of curves. They take light away, however thin they are, and receive nothing.
struct Curves {
  std::string name;  ///< file, for messages
  std::shared_ptr<const Strands> strands;
  glm::dmat4 local_to_world{1.0};  ///< turns, mirrors, moves and scales by one factor, as radii do
  CurveShape shape = CurveShape::round;
  bool casts = true;
  glm::vec3 base_color{0.45F, 0.32F, 0.2F};  ///< linear RGB; pictures only
};

/// Throws Error (input) "name:field: reason" for curves that are not as described above. Baking calls it.
/// O(points).
void check_curves(const Curves& curves);

/// Whether curves take any light away.
[[nodiscard]] inline bool casts_shadows(const Curves& curves) {
  return curves.casts && curves.strands && !curves.strands->segments.empty();
}

/// The factor by which a placement scales lengths.
[[nodiscard]] double length_scale(const glm::dmat4& local_to_world);

}  // namespace pdsm
