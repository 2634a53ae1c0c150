// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace pdsm {

/// IEC 61966-2-1; both from 0 to 1.
[[nodiscard]] inline double srgb_to_linear(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace pdsm
