// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "pdsm/bake/bake.h"

namespace pdsm {

/// By what maps twice as fine multiply the time: 1.8 to 2 on four scenes of 512^2 texels.
inline constexpr double kFinerMapsWork = 2;

/// The options that decide error, time and bytes, and that goals choose.
struct Settings {
  std::uint32_t samples = 64;
  std::uint32_t width = 256, height = 256;  ///< texels
  double epsilon = 0.02;
  /// Texels of the sample maps along each texel of the map: 1 or 2. 0: the maps' size is given, whatever
  /// the map's.
  std::uint32_t maps_per_texel = 1;

  /// Edge of the square map of as many texels.
  [[nodiscard]] double edge() const { return std::sqrt(static_cast<double>(width) * height); }
  /// Samples x texels, times what finer maps take. Rays traced, rays walked and events all grow with it, and
  /// so does the time. Unlike their counts it does not depend on tiles and threads.
  [[nodiscard]] double work() const {
    return static_cast<double>(samples) * width * height * (maps_per_texel == 2 ? kFinerMapsWork : 1);
  }

  bool operator==(const Settings&) const = default;
};

/// The settings among a bake's options, and back into them.
[[nodiscard]] Settings settings_of(const BakeOptions& options);
[[nodiscard]] BakeOptions with_settings(BakeOptions options, const Settings& settings);

/// "256 samples, 512 x 512 texels, epsilon 0.02".
[[nodiscard]] std::string settings_text(const Settings& settings);

}  // namespace pdsm
