// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "pdsm/bake/scene.h"
#include "truth/volume_shadows.h"

namespace pdsm {

/// A scene's volumes as they are seen: light that arrives in them and is scattered once. Any thread.
class VolumePicture {
 public:
  explicit VolumePicture(const Scene& scene) : volumes_(scene) {}

  /// Light that arrives at a point of a volume, from all sides.
  using Arriving = std::function<glm::vec3(const glm::dvec3& position)>;

  /// What is seen along a ray from `eye`, `direction` of length 1, where `behind` is seen at `distance`
  /// metres (infinity: the background).
  [[nodiscard]] glm::vec3 over(const glm::dvec3& eye, const glm::dvec3& direction, double distance,
                               const glm::vec3& behind, const Arriving& arriving) const;

 private:
  VolumeShadows volumes_;
};

}  // namespace pdsm
