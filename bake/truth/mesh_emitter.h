// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Where the unit square goes on a mesh: equal areas to equal areas, triangle after triangle. O(triangles).
[[nodiscard]] glm::dvec3 mesh_surface_point(const Mesh& mesh, const std::array<double, 2>& unit);

/// A mesh light for shadow rays: what a point sees of it, and the baker's model of it. Light space, which is
/// the mesh's. Has nothing in common with the baker's samples (light/mesh_samples.h). Any thread.
class MeshEmitter {
 public:
  /// Borrows the mesh. Throws Error (resource) when Embree fails.
  explicit MeshEmitter(const Mesh& mesh);

  struct Seen {
    glm::dvec3 point;
    double weight =
        0;  ///< of the light that arrives from there; 0 of what faces away or lies behind the rest
  };
  /// A point of the surface and how much is seen of what is around it, from `from`: the solid angle of an
  /// area, up to a factor. Closed meshes emit outwards, others to both sides.
  [[nodiscard]] Seen seen(const glm::dvec3& from, const std::array<double, 2>& unit) const;

  /// A point of the model (docs/maths.md, "Mesh lights"): of a closed mesh on the chord from a point of the
  /// surface, for five numbers of [0, 1); of others that point.
  [[nodiscard]] glm::dvec3 model_point(const std::array<double, 2>& unit,
                                       const std::array<double, 2>& heading, double along) const;

 private:
  struct Place {
    glm::dvec3 point, normal;  ///< outwards of closed meshes
  };
  [[nodiscard]] Place place(const std::array<double, 2>& unit) const;
  [[nodiscard]] bool hides_itself(const glm::dvec3& from, const glm::dvec3& to_point) const;

  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  const Mesh& mesh_;
  std::vector<double> area_;  ///< of triangles 0 .. n
  double size_ = 0;           ///< farthest from the light's centre, metres
  double outwards_ = 1;       ///< times a winding's normal
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace pdsm
