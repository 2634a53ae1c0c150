// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "pdsm/bake/scene.h"
#include "truth/world_scene.h"

namespace pdsm {

/// What a viewing ray meets.
struct SurfacePoint {
  glm::dvec3 position;  ///< world, metres
  glm::vec3 normal;     ///< for shading: smooth, unit, towards the viewer
  glm::vec3 colour;     ///< linear RGB
  bool casts;           ///< shadows
};

/// All geometry and curves of a scene, casting or not, to be looked at, and through its holes. Any thread may
/// trace.
class PictureScene {
 public:
  /// Borrows `scene`, which must outlive it. Throws Error (resource) when Embree fails.
  explicit PictureScene(const Scene& scene);

  /// The first surface from `origin` (world) along `direction`.
  [[nodiscard]] std::optional<SurfacePoint> trace(const glm::dvec3& origin,
                                                  const glm::dvec3& direction) const;

  /// Whether nothing lies between two world points, short of the second by a thousandth of the way.
  [[nodiscard]] bool sees(const glm::dvec3& from, const glm::dvec3& to) const;

 private:
  using CornerNormals = std::vector<std::array<glm::vec3, 3>>;

  const Scene& scene_;
  WorldScene world_;
  std::vector<std::shared_ptr<const CornerNormals>> normals_;  ///< of each geometry
};

}  // namespace pdsm
