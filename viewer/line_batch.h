// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gl_objects.h"
#include "shader_program.h"

namespace pdsm {

/// Smooth lines of any width, gathered for a frame and drawn at once.
class LineBatch {
 public:
  LineBatch();

  /// Begins a frame of this camera and size.
  void begin(const glm::mat4& world_to_clip, int width, int height);
  /// A line between points in metres from the origin; `width` in pixels; display colour with opacity.
  void add(const glm::vec3& from, const glm::vec3& to, float width, const glm::vec4& colour);
  void add_strip(std::span<const glm::vec3> points, float width, const glm::vec4& colour);
  /// Draws what was added, behind what is nearer.
  void draw(const ShaderProgram& program);

 private:
  struct Vertex {
    glm::vec4 clip, colour;
    glm::vec2 side;  // -1 or 1; half the width, pixels
  };

  glm::mat4 world_to_clip_{1};
  glm::vec2 half_size_{1};
  std::vector<Vertex> vertices_;
  GlVertexArray array_;
  GlBuffer buffer_;
};

}  // namespace pdsm
