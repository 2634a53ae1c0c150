// SPDX-License-Identifier: Apache-2.0
#include "camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace pdsm {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;
/// Steepest view up or down, short of where left and right swap.
constexpr double kSteepest = 89 * kDegrees;

struct Axes {
  glm::dvec3 right, up, forward;
};

/// As CameraRays has them.
Axes axes_of(const Camera& camera) {
  Axes axes;
  axes.forward = glm::normalize(camera.target - camera.eye);
  const bool steep = std::abs(axes.forward.y) > 0.9999;
  const glm::dvec3 upright = steep ? glm::dvec3(0, 0, axes.forward.y < 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
  axes.right = glm::normalize(glm::cross(axes.forward, upright));
  axes.up = glm::cross(axes.right, axes.forward);
  return axes;
}

}  // namespace

void CameraControl::set(const Camera& camera, double reach) {
  camera_ = camera;
  reach_ = reach;
}

void CameraControl::orbit(double right, double up) {
  turn(-right, -up, true);
}

void CameraControl::look(double right, double up) {
  turn(right, up, false);
}

void CameraControl::turn(double right, double up, bool around_target) {
  const glm::dvec3 view = camera_.target - camera_.eye;
  const double distance = glm::length(view);
  const double pitch =
      std::clamp(std::asin(std::clamp(view.y / distance, -1.0, 1.0)) + up, -kSteepest, kSteepest);
  const double yaw = std::atan2(view.x, -view.z) + right;
  const glm::dvec3 turned = distance * glm::dvec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                                                  -std::cos(yaw) * std::cos(pitch));
  if (around_target) {
    camera_.eye = camera_.target - turned;
  } else {
    camera_.target = camera_.eye + turned;
  }
}

void CameraControl::pan(double right, double up) {
  const Axes axes = axes_of(camera_);
  const double height =
      2 * glm::distance(camera_.eye, camera_.target) * std::tan(0.5 * camera_.fov * kDegrees);
  const glm::dvec3 step = -height * (right * axes.right + up * axes.up);
  camera_.eye += step;
  camera_.target += step;
}

void CameraControl::approach(double steps) {
  constexpr double kStep = 0.9, kNearest = 1e-3, kFarthest = 50;
  const glm::dvec3 view = camera_.target - camera_.eye;
  const double distance = glm::length(view);
  const double wanted = std::clamp(distance * std::pow(kStep, steps), kNearest * reach_, kFarthest * reach_);
  camera_.eye = camera_.target - view * (wanted / distance);
}

void CameraControl::fly(const glm::dvec3& step) {
  const Axes axes = axes_of(camera_);
  const double distance = glm::distance(camera_.eye, camera_.target);
  const glm::dvec3 by =
      distance * (step.x * axes.right + step.y * glm::dvec3(0, 1, 0) + step.z * axes.forward);
  camera_.eye += by;
  camera_.target += by;
}

CameraMatrices camera_matrices(const Camera& camera, const glm::dvec3& origin, double reach, int width,
                               int height) {
  // What lies beyond is cut; the nearest depth is as small as 24 bits of depth bear.
  constexpr double kRoom = 1.5, kDepthRatio = 1e-4;
  const Axes axes = axes_of(camera);
  const glm::dvec3 eye = camera.eye - origin;
  const double far = kRoom * (reach + glm::length(eye));
  const double near = kDepthRatio * far;
  const double tangent = std::tan(0.5 * camera.fov * kDegrees);
  const double shorter = std::min(width, height);
  const double x = near * tangent * width / shorter, y = near * tangent * height / shorter;
  CameraMatrices matrices;
  matrices.world_to_clip =
      glm::frustum(-x, x, -y, y, near, far) * glm::lookAt(eye, eye + axes.forward, axes.up);
  matrices.pixel_size = tangent / (0.5 * shorter);
  return matrices;
}

glm::dmat4 sub_pixel_shift(int index, int width, int height) {
  // The additive sequence of the plastic number fills the pixel evenly at any count.
  constexpr double kA = 0.7548776662466927, kB = 0.5698402909980532;
  const auto place = [index](double a) { return std::fmod(0.5 + index * a, 1.0) - 0.5; };
  return glm::translate(glm::dmat4(1), glm::dvec3(2 * place(kA) / width, 2 * place(kB) / height, 0));
}

}  // namespace pdsm
