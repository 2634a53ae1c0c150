// SPDX-License-Identifier: Apache-2.0
#include "shader_program.h"

#include <glm/gtc/type_ptr.hpp>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

void compile(GLuint shader, const std::string& name, const std::string& text) {
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return;
  std::string log(2000, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  throw Error(Failure::resource, "shader " + name, log.substr(0, static_cast<std::size_t>(length)));
}

void bind_block(GLuint program, const char* block, GLuint binding) {
  const GLuint index = glGetUniformBlockIndex(program, block);
  if (index != GL_INVALID_INDEX) glUniformBlockBinding(program, index, binding);
}

}  // namespace

ShaderProgram::ShaderProgram(const std::string& name, const std::string& vertex, const std::string& fragment)
    : program_(GlProgram::make()) {
  const GlVertexShader vertex_shader = GlVertexShader::make();
  const GlFragmentShader fragment_shader = GlFragmentShader::make();
  compile(vertex_shader.name(), name + ".vert", vertex);
  compile(fragment_shader.name(), name + ".frag", fragment);
  const GLuint program = program_.name();
  glAttachShader(program, vertex_shader.name());
  glAttachShader(program, fragment_shader.name());
  glLinkProgram(program);
  glDetachShader(program, vertex_shader.name());
  glDetachShader(program, fragment_shader.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) throw Error(Failure::resource, "shader " + name, "does not link");
  bind_block(program, "ViewerFrame", kFrameBinding);
  bind_block(program, "ViewerLights", kLightsBinding);
}

void ShaderProgram::set(const char* uniform, const glm::vec2& value) const {
  glUniform2fv(location(uniform), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* uniform, const glm::vec3& value) const {
  glUniform3fv(location(uniform), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* uniform, const glm::vec4& value) const {
  glUniform4fv(location(uniform), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* uniform, const glm::mat4& value) const {
  glUniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace pdsm
