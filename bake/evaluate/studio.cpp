// SPDX-License-Identifier: Apache-2.0
#include "evaluate/studio.h"

#include <algorithm>
#include <cmath>

#include "truth/light_points.h"

namespace pdsm {
namespace {

constexpr std::array<glm::vec3, 4> kTints{
    {{1.0F, 0.955F, 0.88F}, {0.80F, 0.89F, 1.0F}, {1.0F, 0.84F, 0.72F}, {0.90F, 1.0F, 0.92F}}};

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Times the distance.
double cosine_at_light(const StudioLight& light, const glm::dvec3& to_light, double squared_distance) {
  if (light.direction == glm::dvec3(0)) return std::sqrt(squared_distance);
  const double ahead = -glm::dot(light.direction, to_light);
  return light.two_sided ? std::abs(ahead) : ahead;
}

/// What arrives where the light is as bright as its colour.
float reference_irradiance(const StudioLight& light, const Focus& focus) {
  const glm::dvec3& centre = light.points[light.points.size() / 2];
  const glm::dvec3 ahead = light.direction == glm::dvec3(0) ? glm::dvec3(0, -1, 0) : light.direction;
  const auto arrives = [&light](const glm::dvec3& position, const glm::dvec3& normal) {
    return irradiance(light, position, glm::vec3(normal));
  };
  if (light.distant) return arrives(focus.centre, centre);
  const double distance = glm::distance(centre, focus.centre);
  const glm::dvec3 towards = distance > 0 ? (focus.centre - centre) / distance : ahead;
  const float at_focus =
      arrives(centre + std::max(distance, kStudioLeastDistance * focus.radius) * towards, -towards);
  return at_focus > 0 ? at_focus : arrives(centre + 2 * focus.radius * ahead, -ahead);
}

}  // namespace

glm::vec3 studio_colour(std::size_t index, std::size_t count) {
  const auto lights = static_cast<double>(std::max<std::size_t>(1, count));
  const auto share = static_cast<float>(std::pow(lights, -0.8));
  return kStudioKeyStrength * share * kTints[index % kTints.size()];
}

StudioLight make_studio_light(const Light& light, const Focus& focus, const glm::vec3& colour) {
  const RigidTransform light_to_world = inverse(light_frame(light));
  const glm::dvec3 origin = apply(light_to_world, glm::dvec3(0));
  StudioLight studio;
  studio.distant = is_distant(light);
  studio.two_sided = light.two_sided;
  if (!is_body(light)) studio.direction = apply(light_to_world, glm::dvec3(0, 0, 1)) - origin;
  std::size_t n = 0;
  for (const double u : {1 / 6.0, 0.5, 5 / 6.0}) {
    for (const double v : {1 / 6.0, 0.5, 5 / 6.0}) {
      const glm::dvec3 p = apply(light_to_world, light_point(light, {u, v}));
      studio.points[n++] = studio.distant ? glm::normalize(origin - p) : p;
    }
  }
  const float reference = reference_irradiance(studio, focus);
  studio.colour = colour / reference;
  return studio;
}

float irradiance(const StudioLight& light, const glm::dvec3& position, const glm::vec3& normal) {
  double sum = 0;
  for (const glm::dvec3& on_light : light.points) {
    const glm::dvec3 to_light = light.distant ? on_light : on_light - position;
    const double squared = std::max(glm::dot(to_light, to_light), 1e-30);
    const double at_surface = glm::dot(glm::dvec3(normal), to_light),
                 at_light = cosine_at_light(light, to_light, squared);
    if (at_surface > 0 && at_light > 0) sum += at_surface * at_light / (squared * squared);
  }
  return static_cast<float>(sum / static_cast<double>(light.points.size()));
}

glm::vec3 studio_background(const glm::dvec3& direction) {
  const double height = smooth_step(0.0, kStudioZenithHeight, direction.y);
  return glm::mix(kStudioHorizon, kStudioZenith, static_cast<float>(height));
}

float studio_fade(const Focus& focus, const glm::dvec3& position) {
  const double away = glm::distance(position, focus.centre) / focus.radius;
  return static_cast<float>(smooth_step(kStudioFadeBegin, kStudioFadeEnd, away));
}

}  // namespace pdsm
