// SPDX-License-Identifier: Apache-2.0
#include "surface_capture.h"

#include "gl_objects.h"
#include "pdsm/format/error.h"

namespace pdsm {

CapturedSurfaces capture_surfaces(const ShaderProgram& program, const FrameTargets& targets, int lights) {
  CapturedSurfaces captured;
  captured.width = targets.width();
  captured.height = targets.height();
  const auto pixels = static_cast<std::size_t>(captured.width) * static_cast<std::size_t>(captured.height);
  captured.positions.resize(pixels);
  glBindTexture(GL_TEXTURE_2D, targets.position_texture());
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, captured.positions.data());

  const GlRenderbuffer look_up = GlRenderbuffer::make();
  const GlFramebuffer target = GlFramebuffer::make();
  glBindRenderbuffer(GL_RENDERBUFFER, look_up.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RG32F, captured.width, captured.height);
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, look_up.name());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(Failure::resource, "OpenGL", "can't draw look-ups into a picture of this size");
  }
  program.use();
  for (int light = 0; light < lights; ++light) {
    program.set("light", light);
    targets.fill();
    std::vector<glm::vec2>& values = captured.look_ups.emplace_back(pixels);
    glReadPixels(0, 0, captured.width, captured.height, GL_RG, GL_FLOAT, values.data());
  }
  return captured;
}

}  // namespace pdsm
