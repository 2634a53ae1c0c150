// SPDX-License-Identifier: Apache-2.0
#include "evaluate/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pdsm {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

}  // namespace

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : forward_(glm::normalize(camera.target - camera.eye)),
      half_width_(0.5 * width),
      half_height_(0.5 * height),
      per_pixel_(std::tan(0.5 * camera.fov * kDegrees) / (0.5 * std::min(width, height))) {
  // Looking straight up or down, the picture's top is -z or +z.
  const bool steep = std::abs(forward_.y) > 0.9999;
  const glm::dvec3 upright = steep ? glm::dvec3(0, 0, forward_.y < 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
  right_ = glm::normalize(glm::cross(forward_, upright));
  up_ = glm::cross(right_, forward_);
}

glm::dvec3 CameraRays::direction(double x, double y) const {
  return glm::normalize(forward_ + (x - half_width_) * per_pixel_ * right_ +
                        (half_height_ - y) * per_pixel_ * up_);
}

}  // namespace pdsm
