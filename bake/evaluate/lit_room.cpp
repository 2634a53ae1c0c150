// SPDX-License-Identifier: Apache-2.0
#include "evaluate/lit_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pdsm {
namespace {

constexpr int kDirections = 400;

/// Points of a spiral around the y axis: evenly over the sphere.
glm::dvec3 spiral_direction(int i) {
  constexpr double kTurn = std::numbers::pi * 0.7639320225002103;  // the golden angle
  const double y = 1 - (2 * i + 1.0) / kDirections, across = std::sqrt(1 - y * y);
  return {across * std::cos(i * kTurn), y, across * std::sin(i * kTurn)};
}

/// Past surfaces that cast nothing: lamps' glasses and shades.
std::optional<glm::dvec3> first_caster(const PictureScene& picture, glm::dvec3 origin,
                                       const glm::dvec3& direction, double step) {
  constexpr int kLayers = 8;
  for (int layer = 0; layer < kLayers; ++layer) {
    const std::optional<SurfacePoint> point = picture.trace(origin, direction);
    if (!point) return std::nullopt;
    if (point->casts) return point->position;
    origin = point->position + step * direction;
  }
  return std::nullopt;
}

/// Without a twentieth of the points at either end of each axis.
struct Bounds {
  glm::dvec3 low, high;
};

Bounds inner_bounds(const LitRoom& room) {
  Bounds bounds{};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const glm::dvec3& point : room.points) along.push_back(point[axis]);
    std::sort(along.begin(), along.end());
    const std::size_t cut = along.size() / 20;
    bounds.low[axis] = along[cut];
    bounds.high[axis] = along[along.size() - 1 - cut];
  }
  return bounds;
}

std::ptrdiff_t points_in_view(const PictureScene& picture, const Camera& camera, const LitRoom& room) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const double least = std::cos(glm::radians(0.5 * camera.fov));
  return std::count_if(room.points.begin(), room.points.end(), [&](const glm::dvec3& point) {
    const glm::dvec3 to_point = point - camera.eye;
    return glm::dot(to_point, forward) > least * glm::length(to_point) && picture.sees(camera.eye, point);
  });
}

}  // namespace

std::optional<LitRoom> find_lit_room(const PictureScene& picture, const Light& light, double start) {
  if (is_distant(light)) return std::nullopt;
  const RigidTransform to_world = inverse(light_frame(light));
  LitRoom room{apply(to_world, glm::dvec3(0)), {}};
  const glm::dvec3 axis = apply(to_world, glm::dvec3(0, 0, 1)) - room.lamp;
  int asked = 0;
  for (int i = 0; i < kDirections; ++i) {
    const glm::dvec3 direction = spiral_direction(i);
    glm::dvec3 origin = room.lamp;
    if (!is_body(light)) {
      constexpr double kGrazing = 0.05;
      const double ahead = glm::dot(direction, axis);
      if ((light.two_sided ? std::abs(ahead) : ahead) < kGrazing) continue;
      origin += std::copysign(start, ahead) * axis;
    }
    ++asked;
    constexpr double kBefore = 0.02;  // of the way, so that other sides of thin walls do not see it
    if (const auto met = first_caster(picture, origin, direction, start))
      room.points.push_back(glm::mix(*met, origin, kBefore));
  }
  if (2 * room.points.size() < static_cast<std::size_t>(asked)) return std::nullopt;
  return room;
}

Focus focus_on_room(const LitRoom& room) {
  const auto [low, high] = inner_bounds(room);
  return {0.5 * (low + high), 0.5 * glm::length(high - low)};
}

Camera camera_in_room(const PictureScene& picture, const LitRoom& room) {
  constexpr double kFov = 70, kOffWall = 0.12;
  const auto [low, high] = inner_bounds(room);
  const glm::dvec3 middle = 0.5 * (low + high);
  Camera best{};
  // Views from eyes' height come before all others.
  std::array<std::ptrdiff_t, 2> most{-1, -1};
  for (const glm::dvec3& point : room.points) {
    const Camera camera{glm::mix(point, room.lamp, kOffWall), middle, kFov};
    const double height = (camera.eye.y - low.y) / std::max(high.y - low.y, 1e-30);
    const bool upright = height > 0.4 && height < 0.75;
    const std::array<std::ptrdiff_t, 2> shows{upright ? 1 : 0, points_in_view(picture, camera, room)};
    if (camera.eye == middle || shows <= most) continue;
    most = shows;
    best = camera;
  }
  return best;
}

}  // namespace pdsm
