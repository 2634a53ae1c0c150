// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "evaluate/camera.h"

namespace pdsm {

/// A camera that a person moves: around its target, or through the scene. World space, metres.
class CameraControl {
 public:
  /// Takes a camera's place; `reach` (metres): how large the scene around the target is.
  void set(const Camera& camera, double reach);
  [[nodiscard]] const Camera& camera() const { return camera_; }

  /// Around the target; radians to the right and up.
  void orbit(double right, double up);
  /// Looks elsewhere from the same place; radians to the right and up.
  void look(double right, double up);
  /// Moves eye and target sideways; shares of the picture's shorter side.
  void pan(double right, double up);
  /// Towards the target; each step a tenth of the way.
  void approach(double steps);
  /// Through the scene: right, up, forward in units of the distance to the target.
  void fly(const glm::dvec3& step);

 private:
  void turn(double right, double up, bool around_target);

  Camera camera_;
  double reach_ = 1;
};

/// Where a camera's picture of some size shows the positions that are measured from `origin`; OpenGL's clip
/// space. `reach` (metres): how far from the origin anything is.
struct CameraMatrices {
  glm::dmat4 world_to_clip{1};
  double pixel_size = 0;  ///< metres of a pixel at a view depth of 1 m
};
[[nodiscard]] CameraMatrices camera_matrices(const Camera& camera, const glm::dvec3& origin, double reach,
                                             int width, int height);

/// Moves the picture by less than a pixel, for picture `index` of those that are averaged; the first stays.
[[nodiscard]] glm::dmat4 sub_pixel_shift(int index, int width, int height);

}  // namespace pdsm
