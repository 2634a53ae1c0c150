// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pdsm/bake/bake.h"

/// Point sets of the unit square and the unit disk that the samples of lights are made from, equal areas for
/// equal numbers of points. Pure functions; any thread.
namespace pdsm {

using Point2 = std::array<double, 2>;

/// The powers of the inverse plastic number, the two-dimensional counterpart of the golden ratio.
/// Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
inline constexpr double kInversePlastic = 0.75487766624669276;
inline constexpr double kInversePlasticSquared = 0.56984029099805327;

/// Which set, of how many points; seed 0 shifts no lattice.
struct SampleSet {
  std::uint32_t count = 1;
  PointSet points = PointSet::lattice;
  std::uint64_t seed = 0;
};

/// x - floor(x).
[[nodiscard]] double fraction(double x);

/// Uniform in [0, 1), a pure function of its arguments.
[[nodiscard]] double hash_uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension);

/// Shift of a point set that a seed selects, in [0, 1).
[[nodiscard]] double seed_shift(std::uint64_t seed, std::uint64_t dimension);

/// The Fibonacci lattice, whose first coordinate is even.
[[nodiscard]] Point2 lattice_point(const SampleSet& set, std::uint32_t i);

/// One point in each stratum of area 1/count: `rows` rows, each as high as its strata are many.
[[nodiscard]] Point2 jittered_point(const SampleSet& set, std::uint32_t i, std::uint32_t rows);

/// Rows that make near-square strata of the square.
[[nodiscard]] std::uint32_t square_rows(std::uint32_t count);

/// Of either kind, in the square.
[[nodiscard]] Point2 square_point(const SampleSet& set, std::uint32_t i);

/// Of either kind, in the disk of radius 1.
[[nodiscard]] Point2 disk_point(const SampleSet& set, std::uint32_t i);

}  // namespace pdsm
