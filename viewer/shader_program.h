// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "gl_objects.h"

namespace pdsm {

/// Bindings of uniform blocks; the maps' tables take the first.
enum UniformBinding : GLuint { kTablesBinding = 0, kFrameBinding = 1, kLightsBinding = 2 };

/// A linked program. Uniforms that a program does not use are left out.
class ShaderProgram {
 public:
  ShaderProgram() = default;
  /// Compiles and links texts that begin with their #version line, and points the program's uniform blocks at
  /// their bindings. Throws Error (resource) "shader NAME: log" when the GL refuses them.
  ShaderProgram(const std::string& name, const std::string& vertex, const std::string& fragment);

  [[nodiscard]] GLuint name() const { return program_.name(); }

  /// All setters need use() first.
  void use() const { glUseProgram(program_.name()); }
  void set(const char* uniform, int value) const { glUniform1i(location(uniform), value); }
  void set(const char* uniform, GLuint value) const { set(uniform, static_cast<int>(value)); }
  void set(const char* uniform, float value) const { glUniform1f(location(uniform), value); }
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::mat4& value) const;

 private:
  [[nodiscard]] GLint location(const char* uniform) const {
    return glGetUniformLocation(program_.name(), uniform);
  }

  GlProgram program_;
};

}  // namespace pdsm
