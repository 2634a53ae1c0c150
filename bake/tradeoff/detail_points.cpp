// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/detail_points.h"

#include <cmath>

#include "evaluate/picture_scene.h"
#include "pdsm/runtime/look_up.h"
#include "truth/shadow_rays.h"

namespace pdsm {

DetailPoints::DetailPoints(const Scene& scene, const Light& light, double near_depth, const Camera& camera,
                           std::uint32_t width, std::uint32_t height, std::uint32_t truth_samples)
    : pixels_(std::size_t{width} * height) {
  const PictureScene pictures(scene);
  const CameraRays rays(camera, width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto seen = pictures.trace(camera.eye, rays.direction(x + 0.5, y + 0.5));
      if (!seen) continue;
      const glm::dvec3 to_light = is_distant(light) ? -light.direction : light.position - seen->position;
      if (glm::dot(glm::dvec3(seen->normal), to_light) <= 0) continue;
      pixel_.push_back(std::size_t{y} * width + x);
      points_.push_back(seen->position);
    }
  }
  truth_ = ShadowRays(scene, light, near_depth).attenuations(points_, truth_samples, 0);
}

std::vector<float> DetailPoints::differences(const PenumbraMap& map) const {
  const PenumbraLookUp look_up(map);
  std::vector<float> differences(pixels_, -1);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const LookUpResult found = look_up.at({points_[n].x, points_[n].y, points_[n].z}, Filter::bilinear);
    // Outside the window a map says nothing.
    if (found.status == PointStatus::outside || found.status == PointStatus::behind) continue;
    differences[pixel_[n]] = static_cast<float>(std::abs(static_cast<double>(found.attenuation) - truth_[n]));
  }
  return differences;
}

}  // namespace pdsm
