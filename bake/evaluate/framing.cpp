// SPDX-License-Identifier: Apache-2.0
#include "evaluate/framing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "evaluate/lit_room.h"
#include "truth/world_scene.h"

namespace pdsm {
namespace {

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
  const double distance = kRoom * focus.radius / std::sin(glm::radians(0.5 * camera.fov));
  const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        std::cos(azimuth) * std::cos(elevation));
  camera.eye = camera.target + distance * back;
  return camera;
}

/// From all sides, the most pleasant ones first.
std::vector<Camera> cameras_around(const Focus& focus) {
  std::vector<Camera> cameras;
  for (const double elevation : {27.0, 10.0, 52.0})
    for (const double azimuth : {35.0, -35.0, 0.0, 90.0, -90.0, 145.0, -145.0, 180.0})
      cameras.push_back(orbit_camera(focus, glm::radians(azimuth), glm::radians(elevation)));
  return cameras;
}

Camera first_nearly_best(std::span<const Camera> cameras, const PictureScene& picture,
                         std::span<const glm::dvec3> points) {
  std::vector<std::ptrdiff_t> seen;
  for (const Camera& camera : cameras) {
    seen.push_back(std::count_if(points.begin(), points.end(),
                                 [&](const glm::dvec3& point) { return picture.sees(camera.eye, point); }));
  }
  constexpr double kNearlyBest = 0.85;
  const double enough = kNearlyBest * static_cast<double>(*std::max_element(seen.begin(), seen.end()));
  const auto first = std::find_if(seen.begin(), seen.end(),
                                  [&](std::ptrdiff_t n) { return static_cast<double>(n) >= enough; });
  return cameras[static_cast<std::size_t>(first - seen.begin())];
}

/// Whether some camera sees a tenth of the room.
bool seen_by_any(std::span<const Camera> cameras, const PictureScene& picture, const LitRoom& room) {
  constexpr std::ptrdiff_t kParts = 10;
  return std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
    // From the points outwards: rays end a thousandth short, which is more than walls are thick.
    const auto seen = std::count_if(room.points.begin(), room.points.end(),
                                    [&](const glm::dvec3& point) { return picture.sees(point, camera.eye); });
    return kParts * seen >= std::ssize(room.points);
  });
}

/// The first light's, if none shines on what a camera sees.
std::optional<LitRoom> hidden_room(const PictureScene& picture, std::span<const Light> lights,
                                   const Focus& focus, std::span<const Camera> cameras) {
  constexpr double kStart = 1e-4;  // radii
  std::optional<LitRoom> first;
  for (const Light& light : lights) {
    std::optional<LitRoom> room = find_lit_room(picture, light, kStart * focus.radius);
    if (!room || seen_by_any(cameras, picture, *room)) return std::nullopt;
    if (!first) first = std::move(room);
  }
  return first;
}

}  // namespace

Framing find_framing(const Scene& scene, const PictureScene& picture, std::span<const Light> lights,
                     const std::optional<Camera>& given) {
  const std::vector<Geometry> all = all_surfaces(scene);
  const Focus focus = focus_on_casters(all);
  const std::vector<Camera> cameras = cameras_around(focus);
  if (const std::optional<LitRoom> room = hidden_room(picture, lights, focus, cameras))
    return {focus_on_room(*room), given ? *given : camera_in_room(picture, *room)};
  return {focus, given ? *given : first_nearly_best(cameras, picture, focus_points(all, focus))};
}

}  // namespace pdsm
