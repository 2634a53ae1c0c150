// SPDX-License-Identifier: Apache-2.0
#include "light_outline.h"

#include <cmath>
#include <numbers>

namespace pdsm {
namespace {

std::vector<glm::dvec2> outline_of(const RectLight& rect) {
  const double x = 0.5 * rect.width, y = 0.5 * rect.height;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}, {-x, -y}};
}

/// Of a distant light's marker, in radii of the focus: how far it is from there, and its own radius.
constexpr double kMarkerDistance = 1.5, kMarkerRadius = 0.08;

std::vector<glm::dvec2> circle(double radius) {
  constexpr int kCorners = 48;
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * (i % kCorners) / kCorners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

/// All edges of a box about the light's centre in one line, some of them twice.
std::vector<glm::dvec3> box_outline(const std::array<double, 3>& half, const RigidTransform& to_world) {
  constexpr std::array<unsigned, 16> kCorners{0, 1, 3, 2, 0, 4, 5, 1, 5, 7, 3, 7, 6, 2, 6, 4};
  std::vector<glm::dvec3> outline;
  for (const unsigned corner : kCorners)
    outline.push_back(apply(
        to_world, glm::dvec3((corner & 1U) != 0 ? half[0] : -half[0], (corner & 2U) != 0 ? half[1] : -half[1],
                             (corner & 4U) != 0 ? half[2] : -half[2])));
  return outline;
}

}  // namespace

RigidTransform drawn_frame(const Light& light, const Focus& focus) {
  Light drawn = light;
  if (is_distant(light)) {
    const auto r = light_frame(light).rotation;
    drawn.position = focus.centre - kMarkerDistance * focus.radius * glm::dvec3(r[6], r[7], r[8]);
  }
  return light_frame(drawn);
}

std::vector<glm::dvec3> light_outline(const Light& light, const Focus& focus) {
  const RigidTransform to_world = inverse(drawn_frame(light, focus));
  if (std::holds_alternative<MeshLight>(light.shape)) return box_outline(half_box(light), to_world);
  std::vector<glm::dvec2> in_plane;
  if (const auto* rect = std::get_if<RectLight>(&light.shape))
    in_plane = outline_of(*rect);
  else if (const auto* disk = std::get_if<DiskLight>(&light.shape))
    in_plane = circle(disk->radius);
  else if (const auto* sphere = std::get_if<SphereLight>(&light.shape))
    in_plane = circle(sphere->radius);
  else
    in_plane = circle(kMarkerRadius * focus.radius);
  std::vector<glm::dvec3> outline;
  for (const glm::dvec2& p : in_plane) outline.push_back(apply(to_world, glm::dvec3(p, 0)));
  return outline;
}

}  // namespace pdsm
