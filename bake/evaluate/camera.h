// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "evaluate/picture_scene.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// A pinhole camera, upright (world y).
struct Camera {
  glm::dvec3 eye{0, 0, 1}, target{0};  ///< world, metres
  double fov = 35;                     ///< degrees, of the picture's shorter side
};

/// What a picture is about: a sphere around the casters, without ground and walls that dwarf them.
struct Focus {
  glm::dvec3 centre{0};
  double radius = 1;
};

[[nodiscard]] Focus find_focus(const Scene& scene);

/// A three-quarter view of the focus, from the first side that shows about as much of it as any.
[[nodiscard]] Camera default_camera(const Scene& scene, const PictureScene& picture, const Focus& focus);

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
