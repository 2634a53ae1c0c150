// SPDX-License-Identifier: Apache-2.0
// Skilling, Programming the Hilbert Curve, 2004.
#include "light/hilbert_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace pdsm {
namespace {

/// Bits an axis of a place on the Hilbert curve.
constexpr std::uint32_t kCurveBits = 16;

/// Place on the Hilbert curve of a cube of 2^kCurveBits cells an axis.
std::uint64_t place_on_curve(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t kTop = 1U << (kCurveBits - 1);
  for (std::uint32_t q = kTop; q > 1; q >>= 1U) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& axis : x) {
      if ((axis & q) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & below;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = kTop; q > 1; q >>= 1U)
    if ((x[2] & q) != 0) t ^= q - 1;
  std::uint64_t place = 0;
  for (std::uint32_t bit = kCurveBits; bit-- > 0;)
    for (const std::uint32_t axis : x) place = place << 1U | (((axis ^ t) >> bit) & 1U);
  return place;
}

}  // namespace

void sort_along_hilbert_curve(std::vector<glm::dvec3>& points) {
  glm::dvec3 low(points.front()), high(points.front());
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 size = high - low;
  const double largest = std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
  constexpr double kMost = (1U << kCurveBits) - 1;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    const glm::dvec3 cell = glm::min(std::floor(kMost) * (points[n] - low) / largest, glm::dvec3(kMost));
    order.emplace_back(place_on_curve({static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                                       static_cast<std::uint32_t>(cell.z)}),
                       n);
  }
  std::ranges::sort(order);
  std::vector<glm::dvec3> sorted;
  sorted.reserve(points.size());
  for (const auto& [place, n] : order) sorted.push_back(points[n]);
  points = std::move(sorted);
}

}  // namespace pdsm
