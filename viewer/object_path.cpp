// SPDX-License-Identifier: Apache-2.0
#include "object_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "moving_object.h"
#include "pdsm/runtime/look_up.h"

namespace pdsm {
namespace {

constexpr int kPointsOnPath = 72;

std::vector<glm::dvec3> path_points(const Stage& stage, const Settings& settings) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < kPointsOnPath; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPointsOnPath;
    points.push_back(stage.origin() + glm::dvec3(object_place(stage, settings, angle)));
  }
  return points;
}

/// How many points of the path have something within the object's size, or nothing below them.
int count_obstructed(const Stage& stage, const std::vector<glm::dvec3>& points, double size) {
  const auto is_free = [&](const glm::dvec3& point) {
    for (const double sign : {-1.0, 1.0}) {
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 end = point;
        end[axis] += sign * size;
        if (!stage.picture().sees(point, end)) return false;
      }
    }
    return stage.picture().trace(point, glm::dvec3(0, -1, 0)).has_value();
  };
  int obstructed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool way = stage.picture().sees(points[i], points[(i + 1) % points.size()]);
    if (!way || !is_free(points[i])) ++obstructed;
  }
  return obstructed;
}

/// Sum of all changes of the attenuation around the path, where the maps are exact.
double change_along(const MapLibrary& library, const std::vector<glm::dvec3>& points) {
  double change = 0;
  for (const LoadedMap& loaded : library.maps()) {
    const PenumbraLookUp look_up(loaded.map);
    const auto result = [&](const glm::dvec3& p) { return look_up.at({p.x, p.y, p.z}, Filter::nearest); };
    LookUpResult before = result(points.back());
    for (const glm::dvec3& point : points) {
      const LookUpResult here = result(point);
      const bool both = here.status == PointStatus::inside && before.status == PointStatus::inside;
      if (both) change += std::abs(static_cast<double>(here.attenuation - before.attenuation));
      before = here;
    }
  }
  return change;
}

}  // namespace

void choose_path(const Stage& stage, const MapLibrary& library, Settings& settings) {
  constexpr std::array kSizes{0.14F, 0.1F, 0.07F};
  constexpr std::array kRadii{0.2F, 0.35F, 0.5F, 0.65F, 0.8F, 0.95F};
  constexpr std::array kHeights{0.15F, 0.22F, 0.3F, 0.4F, 0.5F, 0.65F, 0.8F, 1.0F};
  constexpr double kReach = 1.25;    // of the knot's size
  constexpr double kObstacle = 0.5;  // change that makes up for an obstructed point
  constexpr double kLarge = 10;      // and for a smaller object
  double best = -1e9;
  Settings candidate = settings;
  for (const float size : kSizes) {
    for (const float radius : kRadii) {
      for (const float height : kHeights) {
        candidate.object_size = size;
        candidate.path_radius = radius;
        candidate.path_height = height;
        const std::vector<glm::dvec3> points = path_points(stage, candidate);
        const double reach = kReach * stage.focus().radius * static_cast<double>(size);
        const double worth = change_along(library, points) + kLarge * static_cast<double>(size) -
                             kObstacle * count_obstructed(stage, points, reach);
        if (worth <= best) continue;
        best = worth;
        settings = candidate;
      }
    }
  }
}

}  // namespace pdsm
