// SPDX-License-Identifier: Apache-2.0
#include "frame_targets.h"

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "pdsm/format/error.h"
#include "programs.h"

namespace pdsm {
namespace {

GlTexture make_texture(GLint internal, GLenum format, GLint filter, int width, int height) {
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

/// With these colours attached in order, no depth yet; leaves it bound.
GlFramebuffer make_framebuffer(std::initializer_list<const GlTexture*> colours) {
  GlFramebuffer framebuffer = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  std::vector<GLenum> outputs;
  for (const GlTexture* colour : colours) {
    outputs.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(outputs.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, outputs.back(), GL_TEXTURE_2D, colour->name(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
  return framebuffer;
}

void check_complete(const GlFramebuffer& framebuffer) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(Failure::resource, "OpenGL", "can't draw into a picture of this size");
  }
}

void bind_texture(TextureUnit unit, const GlTexture& texture) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, texture.name());
}

}  // namespace

void FrameTargets::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  position_ = make_texture(GL_RGBA32F, GL_RGBA, GL_NEAREST, width, height);
  normal_ = make_texture(GL_RGBA16F, GL_RGBA, GL_NEAREST, width, height);
  colour_ = make_texture(GL_RGBA16F, GL_RGBA, GL_NEAREST, width, height);
  still_ = make_texture(GL_RGBA8, GL_RGBA, GL_NEAREST, width, height);
  picture_ = make_texture(GL_RGBA8, GL_RGBA, GL_LINEAR, width, height);
  depth_ = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_NEAREST, width, height);
  output_ = make_texture(GL_RGBA8, GL_RGBA, GL_NEAREST, width, height);
  mean_ = make_texture(GL_RGBA16F, GL_RGBA, GL_NEAREST, width, height);
  still_depth_ = GlRenderbuffer::make();
  glBindRenderbuffer(GL_RENDERBUFFER, still_depth_.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
  to_surfaces_ = make_framebuffer({&position_, &normal_, &colour_});
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, still_depth_.name());
  to_still_ = make_framebuffer({&still_});
  to_picture_ = make_framebuffer({&picture_});
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  to_air_ = make_framebuffer({&picture_});
  to_output_ = make_framebuffer({&output_});
  to_mean_ = make_framebuffer({&mean_});
  for (const GlFramebuffer* framebuffer :
       {&to_surfaces_, &to_still_, &to_picture_, &to_air_, &to_output_, &to_mean_}) {
    check_complete(*framebuffer);
  }
  width_ = width;
  height_ = height;
}

void FrameTargets::begin_surfaces() const {
  glBindFramebuffer(GL_FRAMEBUFFER, to_surfaces_.name());
  glViewport(0, 0, width_, height_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void FrameTargets::begin_still() const {
  bind_texture(kPositionUnit, position_);
  bind_texture(kNormalUnit, normal_);
  bind_texture(kColourUnit, colour_);
  glBindFramebuffer(GL_FRAMEBUFFER, to_still_.name());
  glViewport(0, 0, width_, height_);
}

void FrameTargets::begin_picture() const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to_picture_.name());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, to_still_.name());
  copy_all(GL_COLOR_BUFFER_BIT);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, to_surfaces_.name());
  copy_all(GL_DEPTH_BUFFER_BIT);
  glViewport(0, 0, width_, height_);
}

void FrameTargets::begin_air() const {
  bind_texture(kDepthUnit, depth_);
  bind_air();
}

void FrameTargets::bind_air() const {
  glBindFramebuffer(GL_FRAMEBUFFER, to_air_.name());
  glViewport(0, 0, width_, height_);
}

void FrameTargets::copy_all(GLbitfield what) const {
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, what, GL_NEAREST);
}

void FrameTargets::fill() const {
  glBindVertexArray(array_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FrameTargets::output_picture(const ShaderProgram* smooth) const {
  if (smooth != nullptr) {
    bind_output();
    bind_texture(kPictureUnit, picture_);
    smooth->use();
    fill();
    return;
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, to_picture_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to_output_.name());
  copy_all(GL_COLOR_BUFFER_BIT);
}

void FrameTargets::add_to_mean(const ShaderProgram& copy, int index) const {
  glBindFramebuffer(GL_FRAMEBUFFER, to_mean_.name());
  bind_texture(kPictureUnit, picture_);
  copy.use();
  glEnable(GL_BLEND);
  glBlendColor(0, 0, 0, 1.0F / static_cast<float>(index + 1));
  glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  fill();
  glDisable(GL_BLEND);
}

void FrameTargets::output_mean(const ShaderProgram& copy) const {
  bind_output();
  bind_texture(kPictureUnit, mean_);
  copy.use();
  fill();
}

void FrameTargets::bind_output() const {
  glBindFramebuffer(GL_FRAMEBUFFER, to_output_.name());
  glViewport(0, 0, width_, height_);
}

void FrameTargets::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, to_output_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  copy_all(GL_COLOR_BUFFER_BIT);
}

RgbImage FrameTargets::read() const {
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  std::vector<std::uint8_t> bytes(4 * width * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, to_output_.name());
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  RgbImage image(static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_));
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* pixel = &bytes[4 * ((height - 1 - y) * width + x)];
      image.pixels[y * width + x] = glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0F;
    }
  }
  return image;
}

}  // namespace pdsm
