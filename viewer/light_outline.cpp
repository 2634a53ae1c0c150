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

std::vector<glm::dvec2> outline_of(const DiskLight& disk) {
  constexpr int kCorners = 48;
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * (i % kCorners) / kCorners;
    points.emplace_back(disk.radius * std::cos(angle), disk.radius * std::sin(angle));
  }
  return points;
}

}  // namespace

std::vector<glm::dvec3> light_outline(const Light& light) {
  const RigidTransform to_world = inverse(light_frame(light));
  std::vector<glm::dvec3> outline;
  const auto in_plane = std::visit([](const auto& shape) { return outline_of(shape); }, light.shape);
  for (const glm::dvec2& p : in_plane) outline.push_back(apply(to_world, glm::dvec3(p, 0)));
  return outline;
}

}  // namespace pdsm
