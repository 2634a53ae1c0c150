// SPDX-License-Identifier: Apache-2.0
#include "light/light_spread.h"

#include <cmath>
#include <limits>

namespace pdsm {

LightSpread::LightSpread(const Light& light) : distant_(is_distant(light)), half_(half_extents(light)) {}

LightSpread::LightSpread(const LightFace& face)
    : distant_(is_distant(face.light)), half_{face.reach[0], face.reach[1]}, half_depth_(face.reach[2]) {
  if (face.front) in_front_ = HalfSpace{*face.front, -face.emitter_skin()};
}

std::array<double, 2> LightSpread::place(const glm::dvec3& p) const {
  if (distant_) return {p.x, p.y};
  return {p.x / p.z, p.y / p.z};
}

Window LightSpread::shadow(const glm::dvec3& p, double deepest) const {
  const double hx = half_[0], hy = half_[1];
  if (distant_) {
    const double rest = deepest - p.z;
    return {p.x - hx * rest, p.y - hy * rest, p.x + hx * rest, p.y + hy * rest};
  }
  return {(p.x - hx) / p.z + hx / deepest, (p.y - hy) / p.z + hy / deepest, (p.x + hx) / p.z - hx / deepest,
          (p.y + hy) / p.z - hy / deepest};
}

ConvexRegion LightSpread::hull_of(const std::array<double, 2>& h, double half_depth, const Window& window,
                                  double far) const {
  ConvexRegion region;
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    glm::dvec3 low(0), high(0);
    low[axis] = 1;
    high[axis] = -1;
    if (distant_) {
      const double spread = h[i] == 0 ? 0 : h[i] * far;
      low.z = high.z = -h[i];
      region.add({low, spread - window[i]});
      region.add({high, spread + window[i + 2]});
    } else if (half_depth > 0) {
      low.z = -window[i];
      high.z = window[i + 2];
      region.add({low, h[i] + std::abs(window[i]) * half_depth});
      region.add({high, h[i] + std::abs(window[i + 2]) * half_depth});
    } else {
      const double spread = h[i] == 0 ? 0 : h[i] / far;
      low.z = -window[i] - spread;
      high.z = window[i + 2] - spread;
      region.add({low, h[i]});
      region.add({high, h[i]});
    }
  }
  if (in_front_) region.add(*in_front_);
  return region;
}

ConvexRegion LightSpread::hull(const Window& window, double far) const {
  return hull_of(half_, half_depth_, window, far);
}

ConvexRegion LightSpread::pyramid(const Window& window) const {
  return hull_of({0, 0}, 0, window, std::numeric_limits<double>::infinity());
}

bool LightSpread::reaches_front(const std::array<glm::dvec3, 3>& triangle) const {
  const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  // The farthest that the emitter (or the directions towards it) reaches along the normal.
  const double reach =
      std::abs(normal.x) * half_[0] + std::abs(normal.y) * half_[1] + std::abs(normal.z) * half_depth_;
  return reach - (distant_ ? normal.z : glm::dot(normal, triangle[0])) > 0;
}

std::array<glm::dvec3, 4> LightSpread::corners(const Window& window, double deepest) const {
  const double x = half_[0], y = half_[1];
  if (!distant_) return {glm::dvec3{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  const double x0 = window[0] - x * deepest, y0 = window[1] - y * deepest, x1 = window[2] + x * deepest,
               y1 = window[3] + y * deepest;
  return {glm::dvec3{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}

}  // namespace pdsm
