// SPDX-License-Identifier: Apache-2.0
// Fibonacci lattice: Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, 1992.
// Sunflower: Vogel, A better way to construct the sunflower head, 1979.
// Concentric map: Shirley, Chiu, A Low Distortion Map Between Disk and Square, 1997.
#include "light/point_sets.h"

#include <cmath>
#include <numbers>

namespace pdsm {
namespace {

constexpr double kInverseGoldenRatio = 0.61803398874989484820;

Point2 concentric_disk(const Point2& square) {
  const double a = 2 * square[0] - 1, b = 2 * square[1] - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b;
  const double phi =
      wide ? std::numbers::pi / 4 * (b / a) : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

Point2 sunflower(const SampleSet& set, std::uint32_t i) {
  const double r = std::sqrt((i + 0.5) / set.count);
  const double phi = 2 * std::numbers::pi * (i * kInverseGoldenRatio + seed_shift(set.seed, 2));
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace

double fraction(double x) {
  return x - std::floor(x);
}

/// SplitMix64's finaliser, twice.
double hash_uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15u + index * 0xD1B54A32D192ED03u + dimension;
  for (int round = 0; round < 2; ++round) {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    x ^= x >> 31;
  }
  return static_cast<double>(x >> 11) * 0x1.0p-53;
}

double seed_shift(std::uint64_t seed, std::uint64_t dimension) {
  return seed == 0 ? 0.0 : hash_uniform(seed, 0, dimension);
}

Point2 lattice_point(const SampleSet& set, std::uint32_t i) {
  return {fraction((i + 0.5) / set.count + seed_shift(set.seed, 2)),
          fraction(0.5 + i * kInverseGoldenRatio + seed_shift(set.seed, 3))};
}

/// Exactly n x n strata for count = n². Row r holds the points floor(r count / rows) .. floor((r + 1) count /
/// rows) - 1.
Point2 jittered_point(const SampleSet& set, std::uint32_t i, std::uint32_t rows) {
  const std::uint64_t n = set.count;
  std::uint64_t row = (std::uint64_t{i} * rows) / n;
  while ((row + 1) * n / rows <= i) ++row;
  const std::uint64_t begin = row * n / rows, end = (row + 1) * n / rows;
  const double x =
      (static_cast<double>(i - begin) + hash_uniform(set.seed, i, 0)) / static_cast<double>(end - begin);
  const double y =
      (static_cast<double>(begin) + static_cast<double>(end - begin) * hash_uniform(set.seed, i, 1)) /
      static_cast<double>(n);
  return {x, y};
}

std::uint32_t square_rows(std::uint32_t count) {
  return static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(count))));
}

Point2 square_point(const SampleSet& set, std::uint32_t i) {
  return set.points == PointSet::lattice ? lattice_point(set, i)
                                         : jittered_point(set, i, square_rows(set.count));
}

Point2 disk_point(const SampleSet& set, std::uint32_t i) {
  return set.points == PointSet::lattice ? sunflower(set, i)
                                         : concentric_disk(jittered_point(set, i, square_rows(set.count)));
}

}  // namespace pdsm
