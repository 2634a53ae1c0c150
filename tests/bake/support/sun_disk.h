// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace pdsm::test {

/// Share of the solid angle of a disk `angle` degrees wide beyond tangent q of a line: rings at angle t from
/// its centre, of which the arc 2 acos(q / tan t) lies beyond. The midpoint rule errs by less than 1e-6.
[[nodiscard]] inline double disk_beyond(double angle, double q) {
  if (q < 0) return 1 - disk_beyond(angle, -q);
  const double most = angle / 2 * std::numbers::pi / 180, least = std::atan(q);
  if (least >= most) return 0;
  constexpr int kRings = 20000;
  double beyond = 0;
  for (int n = 0; n < kRings; ++n) {
    const double t = least + (most - least) * (n + 0.5) / kRings;
    beyond += 2 * std::acos(q / std::tan(t)) * std::sin(t);
  }
  return beyond * (most - least) / kRings / (2 * std::numbers::pi * (1 - std::cos(most)));
}

}  // namespace pdsm::test
