// SPDX-License-Identifier: Apache-2.0
#include "line_batch.h"

#include <cstddef>

namespace pdsm {

LineBatch::LineBatch() : array_(GlVertexArray::make()), buffer_(GlBuffer::make()) {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  const auto add_attribute = [](GLuint attribute, GLint count, std::size_t offset) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, count, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
  };
  add_attribute(0, 4, offsetof(Vertex, clip));
  add_attribute(1, 4, offsetof(Vertex, colour));
  add_attribute(2, 2, offsetof(Vertex, side));
  glBindVertexArray(0);
}

void LineBatch::begin(const glm::mat4& world_to_clip, int width, int height) {
  world_to_clip_ = world_to_clip;
  half_size_ = 0.5F * glm::vec2(width, height);
  vertices_.clear();
}

void LineBatch::add(const glm::vec3& from, const glm::vec3& to, float width, const glm::vec4& colour) {
  glm::vec4 a = world_to_clip_ * glm::vec4(from, 1), b = world_to_clip_ * glm::vec4(to, 1);
  // What lies before the near plane has no place on the screen: it is cut off.
  const float inside_a = a.z + a.w, inside_b = b.z + b.w;
  if (inside_a <= 0 && inside_b <= 0) return;
  constexpr float kInside = 0.999F;
  if (inside_a <= 0) a = glm::mix(b, a, kInside * inside_b / (inside_b - inside_a));
  if (inside_b <= 0) b = glm::mix(a, b, kInside * inside_a / (inside_a - inside_b));

  const glm::vec2 on_a = glm::vec2(a) / a.w * half_size_, on_b = glm::vec2(b) / b.w * half_size_;
  const glm::vec2 along = on_b - on_a;
  const float length = glm::length(along);
  if (!(length > 1e-3F)) return;
  // Half a pixel more on both sides, in which the line fades.
  const float half = 0.5F * width + 0.5F;
  const glm::vec2 aside = half / length * glm::vec2(-along.y, along.x) / half_size_;
  const auto moved = [](const glm::vec4& clip, const glm::vec2& by) {
    return clip + glm::vec4(by * clip.w, 0, 0);
  };
  const glm::vec2 left(1, half), right(-1, half);
  const Vertex corners[] = {{moved(a, aside), colour, left},
                            {moved(a, -aside), colour, right},
                            {moved(b, aside), colour, left},
                            {moved(b, -aside), colour, right}};
  for (const int corner : {0, 1, 2, 2, 1, 3}) vertices_.push_back(corners[corner]);
}

void LineBatch::add_strip(std::span<const glm::vec3> points, float width, const glm::vec4& colour) {
  for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i], width, colour);
}

void LineBatch::draw(const ShaderProgram& program) {
  if (vertices_.empty()) return;
  program.use();
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)), vertices_.data(),
               GL_STREAM_DRAW);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices_.size()));
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace pdsm
