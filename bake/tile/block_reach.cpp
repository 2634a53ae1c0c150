// SPDX-License-Identifier: Apache-2.0
#include "tile/block_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/sample_map.h"

namespace pdsm {

BlockReach::Bounds::Bounds() {
  least.fill(std::numeric_limits<double>::infinity());
  greatest.fill(-std::numeric_limits<double>::infinity());
}

BlockReach::BlockReach(const MapGrid& grid, const LightBounds& light, double first_depth)
    : light_(light), first_depth_(first_depth), inverse_far_(1 / grid.far_depth) {
  for (std::size_t a = 0; a < 2; ++a) {
    origin_[a] = grid.origin[a];
    pad_[a] = kTexelReach * grid.pitch[a];
    blocks_per_slope_[a] = 1 / (grid.pitch[a] * grid.ratio[a].maps_per_texel() * kBlockSize);
    blocks_[a] = blocks_along(grid.texels[a]);
  }
}

void BlockReach::include(const glm::dvec3& corner, Bounds& bounds) const {
  const double inverse = 1 / corner.z, reach = std::max(0.0, inverse - inverse_far_);
  for (std::size_t a = 0; a < 2; ++a) {
    const double slope = corner[static_cast<int>(a)] * inverse;
    bounds.least[a] = std::min(bounds.least[a], slope - light_.max[a] * reach);
    bounds.greatest[a] = std::max(bounds.greatest[a], slope - light_.min[a] * reach);
  }
}

BlockRange BlockReach::of(const std::array<glm::dvec3, 3>& triangle) const {
  Bounds bounds;
  for (std::size_t n = 0; n < 3; ++n) {
    const glm::dvec3 &a = triangle[n], &b = triangle[(n + 1) % 3];
    if (a.z >= first_depth_) include(a, bounds);
    if ((a.z >= first_depth_) != (b.z >= first_depth_)) {
      glm::dvec3 cut = a + (b - a) * ((first_depth_ - a.z) / (b.z - a.z));
      cut.z = first_depth_;
      include(cut, bounds);
    }
  }
  return blocks_of(bounds);
}

BlockRange BlockReach::of_box(const glm::dvec3& low, const glm::dvec3& high) const {
  if (!(low.z >= first_depth_ && high.z * inverse_far_ <= 1)) return {0, 0, blocks_[0], blocks_[1]};
  Bounds bounds;
  for (const double z : {low.z, high.z}) {
    include({low.x, low.y, z}, bounds);
    include({high.x, high.y, z}, bounds);
  }
  return blocks_of(bounds);
}

BlockRange BlockReach::blocks_of(const Bounds& bounds) const {
  std::uint32_t first[2], last[2];
  for (std::size_t a = 0; a < 2; ++a) {
    const auto block = [&](double slope) {
      const double at = std::floor((slope - origin_[a]) * blocks_per_slope_[a]);
      return static_cast<std::int64_t>(std::clamp(at, -1.0, static_cast<double>(blocks_[a])));
    };
    // Of no corner at all, the least is above the greatest.
    const std::int64_t low = block(bounds.least[a] - pad_[a]), high = block(bounds.greatest[a] + pad_[a]) + 1;
    first[a] = static_cast<std::uint32_t>(std::max<std::int64_t>(low, 0));
    last[a] = static_cast<std::uint32_t>(std::min<std::int64_t>(high, blocks_[a]));
  }
  return {first[0], first[1], last[0], last[1]};
}

}  // namespace pdsm
