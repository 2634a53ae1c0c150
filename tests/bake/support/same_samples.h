// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "pdsm/bake/bake.h"
#include "support/scenes.h"

/// The same-samples oracle (numerics.md section 2): the baker's own light samples against plates, by exact
/// intersection in double. It takes the sampling error out; what is left is what the sample maps displace.
namespace pdsm::test {

/// What the maps of a bake make of a scene.
struct MapModel {
  double focus_depth = 1;  ///< of the shared texel grid
  double pitch_x = 0, pitch_y = 0;
  double reach = 0.5;  ///< texels from a point to the centre of the texel that stands for it
  double bias = 0, delta = 0;
};

/// How many samples must be, and may be, blocked at a depth.
struct BlockedCount {
  std::uint32_t certain = 0, possible = 0;
};

/// Least and greatest distance of [p - r, p + r] from being inside [low, high]: whether it is wholly inside,
/// whether it touches.
struct Cover {
  bool wholly, touches;
};
[[nodiscard]] inline Cover cover(double p, double r, double low, double high) {
  return {p - r >= low && p + r <= high, p + r >= low && p - r <= high};
}

/// Samples that block the point (x, y, z): the line from each sample to it meets a plate at depth h < z. A
/// sample's map decides by the line through the centre of a texel, which meets the plate's depth within
///   reach pitch F (h - s_z) / (F - s_z)
/// of the point's own line along each axis. Only samples whose footprint holds an edge are in doubt, and
/// those of plates within bias + delta before z, or delta behind it.
[[nodiscard]] inline BlockedCount count_blocked(std::span<const LightSample> samples,
                                                std::span<const Plate> plates, const MapModel& model,
                                                const std::array<double, 3>& point) {
  const double z = point[2], focus = model.focus_depth;
  BlockedCount count;
  for (const LightSample& sample : samples) {
    const auto& s = sample.position;
    bool certain = false, possible = false;
    for (const Plate& plate : plates) {
      if (plate.z >= z + model.delta) continue;
      const double share = (plate.z - s[2]) / (z - s[2]);
      const double x = s[0] + (point[0] - s[0]) * share, y = s[1] + (point[1] - s[1]) * share;
      // While z moves by delta or by a float's rounding (2^-23), the line moves by so much:
      const double moved = (model.delta + 0x1.0p-23 * z) * share / (z - s[2]) *
                           std::max(std::abs(point[0] - s[0]), std::abs(point[1] - s[1]));
      const double scale = model.reach * focus * (plate.z - s[2]) / (focus - s[2]);
      const Cover a = cover(x, scale * model.pitch_x + moved, plate.x0, plate.x1);
      const Cover b = cover(y, scale * model.pitch_y + moved, plate.y0, plate.y1);
      certain = certain || (a.wholly && b.wholly && plate.z + model.bias + model.delta < z);
      possible = possible || (a.touches && b.touches);
    }
    count.certain += certain ? 1 : 0;
    count.possible += possible ? 1 : 0;
  }
  return count;
}

/// The plain oracle: samples blocked, no maps.
[[nodiscard]] inline std::uint32_t count_blocked_exactly(std::span<const LightSample> samples,
                                                         std::span<const Plate> plates,
                                                         const std::array<double, 3>& point) {
  return count_blocked(samples, plates, {1, 0, 0, 0, 0, 0}, point).certain;
}

}  // namespace pdsm::test
