// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "pdsm/bake/bake.h"

namespace pdsm {

/// The options that decide error, time and bytes, and that goals choose.
struct Settings {
  std::uint32_t samples = 64;
  std::uint32_t width = 256, height = 256;  ///< texels
  double epsilon = 0.02;

  /// Edge of the square map of as many texels.
  [[nodiscard]] double edge() const { return std::sqrt(static_cast<double>(width) * height); }
  /// Samples x texels. Rays traced, rays walked and events all grow with it, and so does the time. Unlike
  /// their counts it does not depend on tiles and threads.
  [[nodiscard]] double work() const { return static_cast<double>(samples) * width * height; }

  bool operator==(const Settings&) const = default;
};

/// The settings among a bake's options, and back into them.
[[nodiscard]] Settings settings_of(const BakeOptions& options);
[[nodiscard]] BakeOptions with_settings(BakeOptions options, const Settings& settings);

/// "256 samples, 512 x 512 texels, epsilon 0.02".
[[nodiscard]] std::string settings_text(const Settings& settings);

}  // namespace pdsm
