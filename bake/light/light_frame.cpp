// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/light_axes.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

// An explicit `up` closer to the direction than this sine leaves too few digits for the other axes.
constexpr double kParallelSine = 1e-6;
// Within 1 degree of the direction the default up of +y gives way to +z.
const double kDefaultUpSine = std::sin(std::numbers::pi / 180);

/// Unit vector of `v`, or zero if it has none. Scaled first: a direction may have any length > 0.
glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (!finite || largest == 0) return glm::dvec3(0);
  const glm::dvec3 scaled = v / largest;
  // Adding 0 turns -0 into 0, which reads better in files and messages.
  return scaled / std::sqrt(glm::dot(scaled, scaled)) + 0.0;
}

bool is_zero(const glm::dvec3& v) {
  return v == glm::dvec3(0);
}

/// The unit up vector that the light's x axis is made from.
glm::dvec3 up_or_default(const Light& light, const glm::dvec3& z) {
  if (light.up) return unit_or_zero(*light.up);
  const glm::dvec3 y_up(0, 1, 0), z_up(0, 0, 1);
  return glm::length(glm::cross(y_up, z)) <= kDefaultUpSine ? z_up : y_up;
}

}  // namespace

FrameFault frame_fault(const Light& light) {
  const glm::dvec3 z = unit_or_zero(light.direction);
  if (is_zero(z)) return FrameFault::zero_direction;
  const glm::dvec3 up = up_or_default(light, z);
  return glm::length(glm::cross(up, z)) <= kParallelSine ? FrameFault::parallel_up : FrameFault::none;
}

RigidTransform light_frame(const Light& light) {
  switch (frame_fault(light)) {
    case FrameFault::zero_direction:
      throw Error(Failure::input, light.name + ".direction", "must be finite and not zero");
    case FrameFault::parallel_up:
      throw Error(Failure::input, light.name + ".up",
                  "must be finite, not zero and not parallel to direction");
    case FrameFault::none:
      break;
  }
  const glm::dvec3 z = unit_or_zero(light.direction);
  // When up is nearly parallel, this x is not quite perpendicular to z; y is, and makes a better x.
  const glm::dvec3 rough_x = glm::cross(up_or_default(light, z), z);
  const glm::dvec3 y = unit_or_zero(glm::cross(z, unit_or_zero(rough_x)));
  const glm::dvec3 x = glm::cross(y, z) + 0.0;
  const glm::dvec3& p = light.position;
  RigidTransform frame;
  frame.rotation = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
  frame.translation = {0 - glm::dot(x, p), 0 - glm::dot(y, p), 0 - glm::dot(z, p)};
  return frame;
}

RigidTransform inverse(const RigidTransform& transform) {
  const auto& r = transform.rotation;
  const auto& t = transform.translation;
  RigidTransform result;
  result.rotation = {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
  result.translation = {-(r[0] * t[0] + r[3] * t[1] + r[6] * t[2]),
                        -(r[1] * t[0] + r[4] * t[1] + r[7] * t[2]),
                        -(r[2] * t[0] + r[5] * t[1] + r[8] * t[2])};
  return result;
}

std::array<double, 2> half_extents(const Light& light) {
  const auto [x, y, z] = half_box(light);
  return {x, y};
}

std::array<double, 3> half_box(const Light& light) {
  if (const auto* rect = std::get_if<RectLight>(&light.shape)) return {rect->width / 2, rect->height / 2, 0};
  if (const auto* sun = std::get_if<DistantLight>(&light.shape)) {
    const double tangent = std::tan(sun->angle / 2 * (std::numbers::pi / 180));
    return {tangent, tangent, 0};
  }
  if (const auto* sphere = std::get_if<SphereLight>(&light.shape))
    return {sphere->radius, sphere->radius, sphere->radius};
  if (const auto* emitter = std::get_if<MeshLight>(&light.shape)) {
    glm::vec3 half(0);
    for (const glm::vec3& p : emitter->mesh->positions) half = glm::max(half, glm::abs(p));
    return {half.x, half.y, half.z};
  }
  const double radius = std::get<DiskLight>(light.shape).radius;
  return {radius, radius, 0};
}

}  // namespace pdsm
