// SPDX-License-Identifier: Apache-2.0
#include "tile/sample_bias.h"

#include <cmath>

#include "walk/ray_path.h"

namespace pdsm {
namespace {

/// A ray of the exact walk passes a map texel within half a texel of its centre.
constexpr double kWalkReach = 0.5;
/// The midpoint walk strays up to half a texel more across its major axis.
constexpr double kMidpointReach = 0.5;
/// Bilinear look-ups ask a ray about points up to a texel beside it, a third of a texel on average. This
/// share of a PDSM texel errs least on the evaluation scenes' surfaces (docs/maths.md).
constexpr double kFilterReach = 0.6;

}  // namespace

MapBias sample_bias(const MapGrid& grid, Walk walk, bool shift_law, const DepthBias& depth_bias,
                    const LightSample& sample) {
  MapBias bias{depth_bias.constant, {}, depth_bias.limited_from};
  for (std::size_t a = 0; a < 2; ++a)
    bias.reach[a] = kWalkReach + kFilterReach * grid.ratio[a].maps_per_texel();
  if (walk == Walk::exact) return bias;
  const RayPath path = make_ray_path(grid, sample, 0, 0);
  const bool x_major = std::abs(path.slope[0]) >= std::abs(path.slope[1]);
  if (!shift_law || !x_major) bias.reach[0] += kMidpointReach;
  if (!shift_law || x_major) bias.reach[1] += kMidpointReach;
  return bias;
}

}  // namespace pdsm
