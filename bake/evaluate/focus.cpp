// SPDX-License-Identifier: Apache-2.0
#include "evaluate/focus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/caster_hull.h"
#include "truth/world_scene.h"

namespace pdsm {
namespace {

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

}  // namespace

std::vector<Geometry> all_surfaces(const Scene& scene) {
  std::vector<Geometry> all = scene.geometry;
  for (CasterHull& hull : caster_hulls(scene)) all.push_back(std::move(hull.surface));
  return all;
}

Focus focus_on_casters(std::span<const Geometry> all) {
  Box around;
  for (const Box& box : subject_boxes(all)) around.add(box);
  if (around.empty() || !(around.diagonal() > 0)) return {};
  return {0.5 * (around.low + around.high), 0.5 * around.diagonal()};
}

}  // namespace pdsm
