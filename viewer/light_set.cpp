// SPDX-License-Identifier: Apache-2.0
#include "light_set.h"

#include <algorithm>
#include <array>

#include "shader_program.h"

namespace pdsm {
namespace {

/// As shaders/lights.glsl declares it (std140).
struct LightEntry {
  glm::vec4 colour, direction;
  std::array<glm::vec4, 9> points;
};
struct LightsData {
  glm::ivec4 count{0};
  std::array<LightEntry, kMostLights> lights{};
};

LightEntry entry_of(const ShownLight& light, const Stage& stage) {
  LightEntry entry{};
  entry.colour = glm::vec4(light.radiance, static_cast<float>(light.map));
  entry.direction = glm::vec4(glm::vec3(light.studio.direction), light.studio.two_sided ? 1.0F : 0.0F);
  std::transform(light.studio.points.begin(), light.studio.points.end(), entry.points.begin(),
                 [&](const glm::dvec3& point) {
                   return light.studio.distant ? glm::vec4(glm::vec3(point), 0.0F)
                                               : glm::vec4(stage.local(point), 1.0F);
                 });
  return entry;
}

}  // namespace

std::vector<LightControl> initial_lights(const Stage& stage, const MapLibrary& library) {
  std::vector<LightControl> controls(stage.scene().lights.size());
  for (std::size_t i = 0; i < controls.size(); ++i) {
    controls[i].on = library.maps().empty() || library.of_light(i) != nullptr;
  }
  return controls;
}

std::vector<ShownLight> shown_lights(const Stage& stage, const MapLibrary& library,
                                     const std::vector<LightControl>& controls) {
  std::vector<ShownLight> shown;
  const std::vector<Light>& lights = stage.scene().lights;
  // The studio's brightness is shared among the lights that have maps, so that switching one leaves the
  // others.
  const std::size_t sharing = library.maps().empty() ? lights.size() : library.maps().size();
  std::size_t tint = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LoadedMap* map = library.of_light(i);
    const std::size_t number = tint;
    if (map != nullptr || library.maps().empty()) ++tint;
    if (!controls[i].on || shown.size() == kMostLights) continue;
    ShownLight light;
    light.light = i;
    light.map = map == nullptr ? -1 : static_cast<int>(map - library.maps().data());
    light.studio = make_studio_light(lights[i], stage.focus(), studio_colour(number, sharing));
    light.radiance = light.studio.colour * controls[i].colour * controls[i].intensity;
    shown.push_back(light);
  }
  return shown;
}

LightBlock::LightBlock() : buffer_(GlBuffer::make()) {
  glBindBuffer(GL_UNIFORM_BUFFER, buffer_.name());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(LightsData), nullptr, GL_DYNAMIC_DRAW);
}

void LightBlock::update(const std::vector<ShownLight>& lights, const Stage& stage) {
  LightsData data;
  data.count.x = static_cast<int>(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) data.lights[i] = entry_of(lights[i], stage);
  glBindBuffer(GL_UNIFORM_BUFFER, buffer_.name());
  glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof(data), &data);
  glBindBufferBase(GL_UNIFORM_BUFFER, kLightsBinding, buffer_.name());
}

}  // namespace pdsm
