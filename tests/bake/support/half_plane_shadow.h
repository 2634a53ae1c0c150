// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "support/baked_functions.h"
#include "support/exact_truth.h"
#include "support/scenes.h"

namespace pdsm::test {

/// Bakes a light about the origin, about 2 m wide, before a half plane whose edge lies at x = 0.3 and z = 3,
/// by both point sets, and holds functions up to z = 8 to attenuation(edge, slope, depth): V where the edge
/// is moved to `edge`, on the ray of that slope in x. `strata`: how many of 256 samples' the edge may cross.
template <typename Attenuation>
void expect_half_plane_shadow(Light light, double strata, Attenuation&& attenuation) {
  constexpr std::uint32_t kSamples = 256;
  constexpr double kEdge = 0.3, kEdgeDepth = 3, kFloor = 8;
  set_view(light, 0.5, 0.25, 2, kFloor);
  Scene scene;
  add(scene, Plate{kEdge, -kWide, kWide, kWide, kEdgeDepth});
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFloor});
  for (const PointSet points : {PointSet::lattice, PointSet::jittered}) {
    BakeOptions options = small_options(33, 5, kSamples);
    options.map_width = 4 * 33;
    options.map_height = 4 * 5;
    options.points = points;
    const BakedFunctions baked(scene, light, options);
    const double moved = texel_reach(options.walk) * baked.map_pitch_x() * kEdgeDepth;
    const double delta = baked.report().depth_tolerance;
    const double slack = sampling_tolerance(strata, kSamples) + baked.report().epsilon;
    for (std::uint32_t i = 0; i < 33; ++i) {
      for (const double z : {4.0, 5.0, 6.5, 7.9}) {
        double low = 1, high = 0;
        for (const double depth : {z - delta, z + delta}) {
          low = std::min(low, attenuation(kEdge + moved, baked.slope_x(i), depth));
          high = std::max(high, attenuation(kEdge - moved, baked.slope_x(i), depth));
        }
        EXPECT_GE(baked.value(i, 2, z), low - slack) << i << " " << z;
        EXPECT_LE(baked.value(i, 2, z), high + slack) << i << " " << z;
      }
    }
  }
}

}  // namespace pdsm::test
