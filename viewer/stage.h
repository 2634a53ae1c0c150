// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>

#include "evaluate/framing.h"
#include "evaluate/picture_scene.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// A scene that was read, and what looking at it needs. Immutable; any thread may trace in it.
class Stage {
 public:
  /// Throws Error as read_scene() does, or (resource).
  explicit Stage(const std::filesystem::path& scene_file);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const PictureScene& picture() const { return picture_; }
  [[nodiscard]] const Focus& focus() const { return framing_.focus; }
  [[nodiscard]] const Camera& camera() const { return framing_.camera; }
  /// What the GPU's positions are measured from, metres.
  [[nodiscard]] const glm::dvec3& origin() const { return framing_.focus.centre; }
  /// Height of the floor about the focus, metres of world y.
  [[nodiscard]] double floor() const { return floor_; }
  /// Distance from the origin within which all geometry and lights lie, metres.
  [[nodiscard]] double reach() const { return reach_; }

  /// A world position as the GPU has it.
  [[nodiscard]] glm::vec3 local(const glm::dvec3& world) const { return glm::vec3(world - origin()); }

 private:
  std::filesystem::path path_;
  Scene scene_;
  PictureScene picture_;
  Framing framing_;
  double floor_ = 0, reach_ = 0;
};

}  // namespace pdsm
