// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/scenes.h"

/// Attenuation in closed form (numerics.md section 2), and what sampling may miss of it (section 3).
namespace pdsm::test {

/// Signed distance from the light's centre at which an edge at depth h, `offset` from the axis, is seen
/// from depth z on the ray of slope d (all along the edge's normal).
[[nodiscard]] inline double back_project(double offset, double h, double d, double z) {
  return z * (offset - h * d) / (z - h);
}

/// Light of length L along the edge's normal, half plane beyond `q`.
[[nodiscard]] inline double rect_half_plane(double length, double q) {
  return std::clamp(0.5 - q / length, 0.0, 1.0);
}

/// Half plane beyond `q` in [-1, 1] before a light two metres wide whose halves emit `left` and `right`.
[[nodiscard]] inline double two_halves(double q, double left, double right) {
  const double x = std::clamp(q, -1.0, 1.0);
  const double hidden = x >= 0 ? right * (1 - x) : right - left * x;
  return hidden / (left + right);
}

/// A plate before a rectangle light, seen from (x, y, z).
[[nodiscard]] inline double rect_plate(double width, double height, const Plate& p, double x, double y,
                                       double z) {
  if (z <= p.z) return 0;
  const auto overlap = [&](double low, double high, double at, double length) {
    const double q0 = back_project(low, p.z, at / z, z), q1 = back_project(high, p.z, at / z, z);
    return std::max(0.0, std::min(q1, length / 2) - std::max(q0, -length / 2)) / length;
  };
  return overlap(p.x0, p.x1, x, width) * overlap(p.y0, p.y1, y, height);
}

/// Square light of side L; half plane beyond distance t of an edge whose normal has angle theta.
[[nodiscard]] inline double square_half_plane(double side, double theta, double t) {
  const double c = std::abs(std::cos(theta)), s = std::abs(std::sin(theta));
  const double a = side * std::max(c, s), b = side * std::min(c, s), tau = std::abs(t);
  double tail = 0;
  if (tau <= (a - b) / 2)
    tail = 0.5 - tau / a;
  else if (tau < (a + b) / 2)
    tail = std::pow((a + b) / 2 - tau, 2) / (2 * a * b);
  return t >= 0 ? tail : 1 - tail;
}

/// Disk light of radius R, half plane beyond distance t.
[[nodiscard]] inline double disk_half_plane(double radius, double t) {
  const double u = std::clamp(t / radius, -1.0, 1.0);
  return (std::acos(u) - u * std::sqrt(1 - u * u)) / std::numbers::pi;
}

/// Radius on the light that a sphere of radius r at depth h on the axis hides from depth z on the axis.
[[nodiscard]] inline double sphere_shadow_radius(double r, double h, double z) {
  return z * r / std::sqrt((z - h) * (z - h) - r * r);
}

/// What N = n x n jittered samples may miss of a shape whose outline crosses `strata` of them: by Hoeffding
/// sqrt(K ln(2 / p) / 2) / N but for p = 1e-6. The lattices are no worse (light_samples_test.cpp).
[[nodiscard]] inline double sampling_tolerance(double strata, double samples) {
  return std::sqrt(strata * std::log(2 / 1e-6) / 2) / samples;
}
/// Strata that one straight edge crosses.
[[nodiscard]] inline double edge_strata(double samples) {
  return 2 * std::sqrt(samples) - 1;
}
/// Strata that the outline of a convex shape crosses.
[[nodiscard]] inline double outline_strata(double samples) {
  return 4 * std::sqrt(samples) - 4;
}

}  // namespace pdsm::test
