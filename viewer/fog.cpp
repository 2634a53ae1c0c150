// SPDX-License-Identifier: Apache-2.0
#include "fog.h"

#include <glm/glm.hpp>

namespace pdsm {
namespace {

constexpr int kShrink = 5;  // along each axis: fog is smooth, and its steps are what a frame costs most

}  // namespace

void Fog::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  picture_ = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, picture_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  target_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture_.name(), 0);
}

void Fog::draw(const Programs& programs, const FrameTargets& targets, const Stage& stage,
               const Settings& settings) {
  resize((targets.width() + kShrink - 1) / kShrink, (targets.height() + kShrink - 1) / kShrink);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, width_, height_);
  constexpr float kAside = 1.5F;  // radii
  const auto radius = static_cast<float>(stage.focus().radius);
  const auto floor = static_cast<float>(stage.floor() - stage.origin().y);
  programs.fog.use();
  programs.fog.set("fog_low", glm::vec3(-kAside * radius, floor, -kAside * radius));
  programs.fog.set("fog_high",
                   glm::vec3(kAside * radius, floor + settings.fog_height * radius, kAside * radius));
  programs.fog.set("density", settings.fog_density / radius);
  programs.fog.set("shrink", kShrink);
  targets.fill();

  targets.bind_air();
  glActiveTexture(GL_TEXTURE0 + kFogUnit);
  glBindTexture(GL_TEXTURE_2D, picture_.name());
  programs.fog_composite.use();
  programs.fog_composite.set("shrink", kShrink);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  targets.fill();
  glDisable(GL_BLEND);
}

}  // namespace pdsm
