// SPDX-License-Identifier: Apache-2.0
#include "moving_object.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace pdsm {
namespace {

constexpr glm::vec3 kColour{0.78F, 0.30F, 0.12F};  // warm, apart from any scene's grey

}  // namespace

glm::vec3 object_place(const Stage& stage, const Settings& settings, double angle) {
  constexpr double kBob = 0.04;  // radii
  const double radius = stage.focus().radius, floor = stage.floor() - stage.origin().y;
  const double aside = radius * settings.path_radius;
  const double up = radius * (settings.path_height + kBob * std::sin(2 * angle));
  return {aside * std::sin(angle), floor + up, aside * std::cos(angle)};
}

glm::mat4 object_motion(const Stage& stage, const Settings& settings, double seconds) {
  constexpr double kAngle = 0.45, kStart = 0.6;  // radians a second; radians
  constexpr float kSpin = 0.9F, kTurned = 0.6F;  // radians a second; radians
  const auto t = static_cast<float>(seconds);
  glm::mat4 motion = glm::translate(glm::mat4(1), object_place(stage, settings, kAngle * seconds + kStart));
  motion = glm::rotate(motion, kSpin * t + kTurned, glm::normalize(glm::vec3(0.35F, 1, 0.2F)));
  return glm::scale(motion, glm::vec3(static_cast<float>(stage.focus().radius) * settings.object_size));
}

void MovingObject::draw(const ShaderProgram& program, const glm::mat4& motion) const {
  program.set("model", motion);
  program.set("base_colour", kColour);
  mesh_.draw();
}

}  // namespace pdsm
