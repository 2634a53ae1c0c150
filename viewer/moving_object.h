// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene_meshes.h"
#include "settings.h"
#include "stage.h"

namespace pdsm {

/// Where the moving object is on its path at an angle (radians): metres from the origin.
[[nodiscard]] glm::vec3 object_place(const Stage& stage, const Settings& settings, double angle);

/// How the moving object lies at a time, about the focus: metres from the origin.
[[nodiscard]] glm::mat4 object_motion(const Stage& stage, const Settings& settings, double seconds);

/// A knot that wanders around the focus through shadow and light. It receives, but casts nothing.
class MovingObject {
 public:
  MovingObject() : mesh_(make_knot()) {}

  /// `program` has to be in use.
  void draw(const ShaderProgram& program, const glm::mat4& motion) const;

 private:
  GpuMesh mesh_;
};

}  // namespace pdsm
