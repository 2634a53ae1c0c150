// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace pdsm {

/// A pinhole camera, upright (world y).
struct Camera {
  glm::dvec3 eye{0, 0, 1}, target{0};  ///< world, metres
  double fov = 35;                     ///< degrees, of the picture's shorter side
};

/// Directions of a camera's viewing rays for a picture of a size.
class CameraRays {
 public:
  CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// Unit direction through (x, y) in pixels from the upper left corner.
  [[nodiscard]] glm::dvec3 direction(double x, double y) const;

 private:
  glm::dvec3 forward_, right_, up_;
  double half_width_, half_height_, per_pixel_;
};

}  // namespace pdsm
