// SPDX-License-Identifier: Apache-2.0
#include "evaluate/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "scene/caster_hull.h"

namespace pdsm {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& box) {
    low = glm::min(low, box.low);
    high = glm::max(high, box.high);
  }
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] double diagonal() const { return empty() ? 0 : glm::length(high - low); }
  /// Ground and walls: hardly any extent along one axis.
  [[nodiscard]] bool flat() const {
    constexpr double kFlat = 0.01;
    const glm::dvec3 size = high - low;
    return std::min({size.x, size.y, size.z}) < kFlat * std::max({size.x, size.y, size.z});
  }
};

Box world_box(const Geometry& geometry) {
  Box box;
  for (const glm::vec3& position : geometry.mesh->positions) {
    const glm::dvec3 world = to_world(geometry, position);
    if (std::isfinite(world.x + world.y + world.z)) box.add(world);
  }
  return box;
}

/// Geometry, and the surfaces around volumes and curves.
std::vector<Geometry> all_surfaces(const Scene& scene) {
  std::vector<Geometry> all = scene.geometry;
  for (CasterHull& hull : caster_hulls(scene)) all.push_back(std::move(hull.surface));
  return all;
}

/// Boxes of the casters that a picture is about; of everything when nothing casts.
std::vector<Box> subject_boxes(std::span<const Geometry> all) {
  const bool any_casts = std::any_of(all.begin(), all.end(), [](const Geometry& g) { return g.casts; });
  std::vector<Box> boxes;
  for (const Geometry& geometry : all) {
    const Box box = world_box(geometry);
    if (!box.empty() && (geometry.casts || !any_casts)) boxes.push_back(box);
  }
  Box solid;
  for (const Box& box : boxes) {
    if (!box.flat()) solid.add(box);
  }
  constexpr double kDwarfs = 1.5;
  const auto dwarfs = [&](const Box& box) {
    return box.flat() && box.diagonal() > kDwarfs * solid.diagonal();
  };
  if (!solid.empty()) boxes.erase(std::remove_if(boxes.begin(), boxes.end(), dwarfs), boxes.end());
  return boxes;
}

/// Some hundred vertices within the focus.
std::vector<glm::dvec3> focus_points(std::span<const Geometry> all, const Focus& focus) {
  constexpr std::size_t kPointsPerGeometry = 200;
  std::vector<glm::dvec3> points;
  for (const Geometry& geometry : all) {
    const std::vector<glm::vec3>& positions = geometry.mesh->positions;
    const std::size_t step = positions.size() / kPointsPerGeometry + 1;
    for (std::size_t i = 0; i < positions.size(); i += step) {
      const glm::dvec3 p = to_world(geometry, positions[i]);
      if (glm::distance(p, focus.centre) <= focus.radius) points.push_back(p);
    }
  }
  return points;
}

Camera orbit_camera(const Focus& focus, double azimuth, double elevation) {
  // A little more than the sphere fits, so that its shadow is in the picture too.
  constexpr double kRoom = 0.98;
  Camera camera;
  camera.target = focus.centre - glm::dvec3(0, 0.12 * focus.radius, 0);
  const double distance = kRoom * focus.radius / std::sin(0.5 * camera.fov * kDegrees);
  const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        std::cos(azimuth) * std::cos(elevation));
  camera.eye = camera.target + distance * back;
  return camera;
}

}  // namespace

Focus find_focus(const Scene& scene) {
  Box all;
  for (const Box& box : subject_boxes(all_surfaces(scene))) all.add(box);
  if (all.empty() || !(all.diagonal() > 0)) return {};
  return {0.5 * (all.low + all.high), 0.5 * all.diagonal()};
}

Camera default_camera(const Scene& scene, const PictureScene& picture, const Focus& focus) {
  const std::vector<glm::dvec3> points = focus_points(all_surfaces(scene), focus);
  std::vector<std::pair<Camera, double>> seen;
  double most = 0;
  for (const double elevation : {27.0, 10.0, 52.0}) {
    for (const double azimuth : {35.0, -35.0, 0.0, 90.0, -90.0, 145.0, -145.0, 180.0}) {
      const Camera camera = orbit_camera(focus, azimuth * kDegrees, elevation * kDegrees);
      const auto count = std::count_if(points.begin(), points.end(), [&](const glm::dvec3& point) {
        return picture.sees(camera.eye, point);
      });
      seen.emplace_back(camera, static_cast<double>(count));
      most = std::max(most, seen.back().second);
    }
  }
  constexpr double kNearlyBest = 0.85;
  return std::find_if(seen.begin(), seen.end(), [&](const auto& s) { return s.second >= kNearlyBest * most; })
      ->first;
}

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : forward_(glm::normalize(camera.target - camera.eye)),
      half_width_(0.5 * width),
      half_height_(0.5 * height),
      per_pixel_(std::tan(0.5 * camera.fov * kDegrees) / (0.5 * std::min(width, height))) {
  // Looking straight up or down, the picture's top is -z or +z.
  const bool steep = std::abs(forward_.y) > 0.9999;
  const glm::dvec3 upright = steep ? glm::dvec3(0, 0, forward_.y < 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
  right_ = glm::normalize(glm::cross(forward_, upright));
  up_ = glm::cross(right_, forward_);
}

glm::dvec3 CameraRays::direction(double x, double y) const {
  return glm::normalize(forward_ + (x - half_width_) * per_pixel_ * right_ +
                        (half_height_ - y) * per_pixel_ * up_);
}

}  // namespace pdsm
