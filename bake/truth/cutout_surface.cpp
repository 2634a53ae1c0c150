// SPDX-License-Identifier: Apache-2.0
#include "truth/cutout_surface.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// Number of the texel that shows at a whole number of texels from the mask's border.
double shown_texel(double texel, double count, MaskWrap wrap) {
  switch (wrap) {
    case MaskWrap::repeat:
      return texel - count * std::floor(texel / count);
    case MaskWrap::mirror: {
      // Texels -1 and 0 are the same, and so are count - 1 and count.
      const double folded = std::abs(std::remainder(texel + 0.5, 2 * count));
      return std::floor(folded);
    }
    case MaskWrap::clamp:
      break;
  }
  return std::clamp(texel, 0.0, count - 1);
}

double alpha_of(const CutoutMask& mask, double x, double y) {
  // Rounding of places that are larger than any texture could land beside the last texel.
  const auto column =
      static_cast<std::size_t>(std::clamp(shown_texel(x, mask.width, mask.wrap[0]), 0.0, mask.width - 1.0));
  const auto row =
      static_cast<std::size_t>(std::clamp(shown_texel(y, mask.height, mask.wrap[1]), 0.0, mask.height - 1.0));
  return mask.alpha[row * mask.width + column] / 255.0;
}

}  // namespace

double mask_alpha(const CutoutMask& mask, const glm::dvec2& place) {
  const double x = place.x * mask.width - 0.5, y = place.y * mask.height - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const double near = std::lerp(alpha_of(mask, x0, y0), alpha_of(mask, x0 + 1, y0), x - x0),
               far = std::lerp(alpha_of(mask, x0, y0 + 1), alpha_of(mask, x0 + 1, y0 + 1), x - x0);
  return std::lerp(near, far, y - y0);
}

bool is_hole(const CutoutMask& mask, const glm::dvec2& place) {
  return !mask.blends && mask_alpha(mask, place) < static_cast<double>(mask.cutoff);
}

bool is_hole(const Mesh& mesh, const glm::uvec3& triangle, const glm::dvec3& weights) {
  if (!mesh.mask) return false;
  glm::dvec2 place(0);
  for (int c = 0; c < 3; ++c) place += weights[c] * glm::dvec2(mesh.mask_places[triangle[c]]);
  return is_hole(*mesh.mask, place);
}

}  // namespace pdsm
