// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include <algorithm>
#include <cmath>

#include "pdsm/bake/scene_file.h"

namespace pdsm {
namespace {

double scene_reach(const Scene& scene, const glm::dvec3& origin) {
  double reach = 0;
  for (const Geometry& geometry : scene.geometry) {
    for (const glm::vec3& position : geometry.mesh->positions) {
      const double distance = glm::distance(to_world(geometry, position), origin);
      if (std::isfinite(distance)) reach = std::max(reach, distance);
    }
  }
  for (const Light& light : scene.lights) {
    if (is_distant(light)) continue;
    const std::array<double, 2> half = half_extents(light);
    reach = std::max(reach, glm::distance(light.position, origin) + half[0] + half[1]);
  }
  return reach;
}

/// The lowest surface straight below a point, through others; the point's own height when there is none.
double lowest_below(const PictureScene& picture, glm::dvec3 point, double step) {
  constexpr int kMostSurfaces = 64;
  double lowest = point.y;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const auto below = picture.trace(point, glm::dvec3(0, -1, 0));
    if (!below) break;
    lowest = below->position.y;
    point.y = lowest - step;
  }
  return lowest;
}

/// The lowest surface below a few points of the focus.
double find_floor(const PictureScene& picture, const Focus& focus) {
  constexpr double kStep = 1e-5;  // radii, past a surface that was met
  double floor = focus.centre.y;
  for (const double x : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
    for (const double z : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
      const glm::dvec3 point = focus.centre + focus.radius * glm::dvec3(x, 0, z);
      floor = std::min(floor, lowest_below(picture, point, kStep * focus.radius));
    }
  }
  return floor;
}

}  // namespace

Stage::Stage(const std::filesystem::path& scene_file)
    : path_(scene_file),
      scene_(read_scene(scene_file)),
      picture_(scene_),
      framing_(find_framing(scene_, picture_, scene_.lights)),
      floor_(find_floor(picture_, focus())),
      reach_(scene_reach(scene_, origin())) {}

}  // namespace pdsm
