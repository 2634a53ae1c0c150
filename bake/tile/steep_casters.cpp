// SPDX-License-Identifier: Apache-2.0
#include "tile/steep_casters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// Points are off their triangles by 2^-9 map texel (trace/raster_map.h), of a reach of half a texel or more;
/// what floats round is less.
constexpr double kSlack = 1.02;

}  // namespace

SteepCasters::SteepCasters(const BakeJob& job)
    : light_(bound_samples(job.samples)), from_(job.slope_limit.from) {
  for (const LightSample& sample : job.samples) {
    const MapBias bias = sample_bias(job.grid, job.options.walk, true, job.depth_bias(), sample);
    for (std::size_t a = 0; a < 2; ++a) reach_[a] = std::max(reach_[a], bias.reach[a] * job.grid.pitch[a]);
  }
}

bool SteepCasters::may_hold(const std::array<glm::vec3, 3>& triangle) const {
  if (std::isinf(from_)) return false;
  // The normal that maps are biased by, rounding and all.
  const glm::dvec3 normal(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  const auto [least_x, most_x] = std::minmax({normal.x * light_.min[0], normal.x * light_.max[0]});
  const auto [least_y, most_y] = std::minmax({normal.y * light_.min[1], normal.y * light_.max[1]});
  double least = std::numeric_limits<double>::infinity(), greatest = -least, depth = 0;
  for (const glm::vec3& corner : triangle) {
    const double at = glm::dot(normal, glm::dvec3(corner));
    least = std::min(least, at - (most_x + most_y));
    greatest = std::max(greatest, at - (least_x + least_y));
    depth = std::max(depth, static_cast<double>(corner.z));
  }
  const double facing = least > 0 ? least : greatest < 0 ? -greatest : 0;
  const double shrink = reach_[0] * std::abs(normal.x) + reach_[1] * std::abs(normal.y);
  // So that slivers without a normal, which are biased by all there is, are steep.
  return !(kSlack * shrink * depth * (depth + from_) < from_ * facing);
}

}  // namespace pdsm
