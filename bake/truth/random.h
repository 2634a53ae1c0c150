// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

/// Numbers from a hash of (seed, index): any element at any time, the same on every machine and for any
/// order of threads, and unlike the baker's lattice.
/// Paper: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014 (the mixer).
namespace pdsm {

[[nodiscard]] constexpr std::uint64_t hash_bits(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t h = seed + 0x9E3779B97F4A7C15ULL * (index + 1);
  for (int round = 0; round < 2; ++round) {
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    h ^= h >> 31;
  }
  return h;
}

/// Uniform in [0, 1).
[[nodiscard]] constexpr double hash_unit(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(hash_bits(seed, index) >> 11) * 0x1p-53;
}

/// Two independent numbers in [0, 1) of 32 bits each.
[[nodiscard]] constexpr std::array<double, 2> hash_unit_pair(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t bits = hash_bits(seed, index);
  return {static_cast<double>(bits >> 32) * 0x1p-32, static_cast<double>(bits & 0xFFFFFFFFU) * 0x1p-32};
}

}  // namespace pdsm
