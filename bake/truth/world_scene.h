// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What rays find in the holes of meshes with masks: the surface as if it were whole, or nothing.
enum class Holes { filled, open };

/// Which triangle of a scene, given by its corners in world space, goes into a WorldScene.
using KeepTriangle = std::function<bool(const std::array<glm::dvec3, 3>&)>;

/// Which curves do; empty: none.
using KeepCurves = std::function<bool(const Curves&)>;

/// A scene's triangles, and curves, in Embree, in world space about the centre of their bounds, so that a
/// scene far from the origin loses no digits. It has nothing in common with the baker's own light-space
/// scene: what is measured and what measures must not share their mistakes. Any thread may trace once it
/// stands. Geometry n of the scene has the geometry id n; its triangles keep their numbers unless some are
/// left out. Curves have the ids behind.
class WorldScene {
 public:
  /// Holds the geometry that `keep` accepts. Borrows its masks. Throws Error (resource) when Embree fails,
  /// and as check_mask() does.
  ~WorldScene();
  WorldScene(const Scene& scene, const std::function<bool(const Geometry&)>& keep, Holes holes,
             const KeepTriangle& keep_triangle = {}, const KeepCurves& keep_curves = {});

  [[nodiscard]] RTCScene handle() const { return scene_.get(); }
  /// (u, v) in the mask of a geometry at a hit's weights of the triangle's second and third corner.
  [[nodiscard]] glm::dvec2 mask_place(unsigned geometry, unsigned triangle, float u, float v) const;
  /// What was subtracted from world space, metres.
  [[nodiscard]] const glm::dvec3& centre() const { return centre_; }

 private:
  struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  struct Cutout;

  void attach(const Geometry& geometry, unsigned id, Holes holes, const KeepTriangle& keep_triangle);
  void attach(const Curves& curves, unsigned id);
  void cut_out(RTCGeometry target, const Mesh& mesh);

  std::vector<std::unique_ptr<const Cutout>> cutouts_;  ///< that filters ask, as long as there are rays
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
  glm::dvec3 centre_{0};
};

/// A point of a geometry's local space in the world, metres.
[[nodiscard]] glm::dvec3 to_world(const Geometry& geometry, const glm::vec3& position);
[[nodiscard]] glm::dvec3 to_world(const Curves& curves, const glm::vec3& position);

}  // namespace pdsm
