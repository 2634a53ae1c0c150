// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "tile/bake_job.h"
#include "trace/light_bounds.h"

namespace pdsm {

/// Which casters may have their slope's bias limited somewhere (trace/surface_bias.h), by a ray that looks
/// for the next receiver.
///
/// On a triangle of normal n, with r the reach of a map texel as a slope, a sample s meets the point P at
/// depth t with the slope's bias
///   t R / (F - R),   R = r_x |n_x| + r_y |n_y|,   F = |n . (P - s)| / t
/// which is above L where R t (t + L) > L |n . (P - s)|. Over the triangle and the light t is at most that of
/// the corners, and n . (P - s) between those of corners and the light's bounds.
class SteepCasters {
 public:
  /// Samples must lie in the light's plane.
  explicit SteepCasters(const BakeJob& job);

  /// True where it can't be ruled out.
  [[nodiscard]] bool may_hold(const std::array<glm::vec3, 3>& triangle) const;

 private:
  LightBounds light_;
  std::array<double, 2> reach_{};  ///< of map texels, slopes
  double from_;                    ///< L, metres; infinite: no slope is limited
};

}  // namespace pdsm
