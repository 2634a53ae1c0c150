// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "events/transmittance_events.h"
#include "support/baked_functions.h"
#include "support/scenes.h"

/// Bakes of casters that let a part of the light through.
namespace pdsm::test {

inline constexpr double kTranslucentEpsilon = 0.002;

[[nodiscard]] inline BakeOptions translucent_options(std::uint32_t edge = 48, std::uint32_t samples = 64) {
  BakeOptions options = small_options(edge, edge, samples);
  options.epsilon = kTranslucentEpsilon;
  options.depth_tolerance = 1e-4;
  options.bias = 0.01;
  options.receivers = Receivers::all;
  return options;
}

/// What a value may be off where all samples see the same: the fit, and rounding to 1/L.
[[nodiscard]] inline double translucent_tolerance(std::uint32_t samples = 64) {
  return kTranslucentEpsilon + 0.5 / transmittance_unit(samples) + 1e-9;
}

/// 1 m wide, sees tangents up to 0.5 and depths from 2 to 8.
[[nodiscard]] inline Light square_light() {
  Light light = rect_light(1, 1);
  set_view(light, 0.5, 0.5, 2, 8);
  return light;
}

/// A plate that fills all of a light's sight.
[[nodiscard]] inline Plate everywhere(double z) {
  return {-kWide, -kWide, kWide, kWide, z};
}

}  // namespace pdsm::test
