// SPDX-License-Identifier: Apache-2.0
#include "tile/sample_bias.h"

#include <algorithm>
#include <cmath>

#include "walk/ray_path.h"

namespace pdsm {
namespace {

/// A ray of the exact walk passes a map texel within half a texel of its centre.
constexpr double kWalkReach = 0.5;
/// The midpoint walk strays up to half a texel more across its major axis.
constexpr double kMidpointReach = 0.5;
/// Bilinear look-ups ask a ray about points up to a PDSM texel beside it. Both reaches together are a whole
/// one, of which at least this share is theirs: what errs least on surfaces (docs/maths.md).
constexpr double kLeastFilterReach = 0.5;

/// In map texels.
double filter_reach(double maps_per_texel) {
  return std::max(maps_per_texel - kWalkReach, kLeastFilterReach * maps_per_texel);
}

}  // namespace

MapBias sample_bias(const MapGrid& grid, Walk walk, bool shift_law, const DepthBias& depth_bias,
                    const LightSample& sample) {
  MapBias bias{depth_bias.constant, {}, depth_bias.limited_from};
  for (std::size_t a = 0; a < 2; ++a)
    bias.reach[a] = kWalkReach + filter_reach(grid.ratio[a].maps_per_texel());
  if (walk == Walk::exact) return bias;
  const RayPath path = make_ray_path(grid, sample, 0, 0);
  const bool x_major = std::abs(path.slope[0]) >= std::abs(path.slope[1]);
  if (!shift_law || !x_major) bias.reach[0] += kMidpointReach;
  if (!shift_law || x_major) bias.reach[1] += kMidpointReach;
  return bias;
}

}  // namespace pdsm
