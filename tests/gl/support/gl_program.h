// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pdsm::testing {

/// A linked program. Throws std::runtime_error with the driver's log when it does not compile or link.
class GlProgram {
 public:
  GlProgram(const std::string& vertex, const std::string& fragment);
  ~GlProgram() { glDeleteProgram(name_); }
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  [[nodiscard]] GLuint name() const { return name_; }
  [[nodiscard]] GLint uniform(const char* name) const { return glGetUniformLocation(name_, name); }

 private:
  GLuint name_;
};

/// One triangle over the whole target, without any buffer: draw_target().
[[nodiscard]] std::string target_vertex_shader(const std::string& version);

/// A float texture as target, with depth; bound while it lives.
class FloatTarget {
 public:
  /// `format`: GL_R32F, GL_RGBA32F, ... (GL_RGBA32UI in ES 3.0, which renders to no floats)
  FloatTarget(std::uint32_t width, std::uint32_t height, GLenum format);
  ~FloatTarget();
  FloatTarget(const FloatTarget&) = delete;
  FloatTarget& operator=(const FloatTarget&) = delete;

  [[nodiscard]] GLuint texture() const { return texture_; }
  void bind() const;

 private:
  std::uint32_t width_, height_;
  GLuint framebuffer_ = 0, texture_ = 0, depth_ = 0;
};

/// Draws target_vertex_shader's triangle with the program in use.
void draw_target();

}  // namespace pdsm::testing
