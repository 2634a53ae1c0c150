// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "evaluate/camera.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// What a camera sees, a point a pixel, with the truth there: so that many maps are compared with shadow rays
/// that are traced once.
class DetailPoints {
 public:
  /// Traces the pixels of a picture of this size. Throws Error (resource) when Embree fails.
  DetailPoints(const Scene& scene, const Light& light, double near_depth, const Camera& camera,
               std::uint32_t width, std::uint32_t height, std::uint32_t truth_samples);

  /// |map - truth| of each pixel, row 0 on top (bilinear); -1 where no surface is seen that faces the light.
  [[nodiscard]] std::vector<float> differences(const PenumbraMap& map) const;

 private:
  std::size_t pixels_;
  std::vector<std::size_t> pixel_;  ///< of each point
  std::vector<glm::dvec3> points_;  ///< world, metres
  std::vector<double> truth_;
};

}  // namespace pdsm
