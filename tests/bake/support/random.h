// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace pdsm::test {

/// Numbers that a seed determines, the same on every machine (the standard's distributions are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15u + 1) {}

  /// In [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [low, high].
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::uint32_t count(std::uint32_t low, std::uint32_t high) {
    return static_cast<std::uint32_t>(integer(low, high));
  }
  bool chance(double probability) { return uniform() < probability; }
  template <typename T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[integer(0, static_cast<std::int64_t>(choices.size()) - 1)];
  }
  template <typename Container>
  const auto& pick_from(const Container& choices) {
    return choices[static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(choices.size()) - 1))];
  }
  template <typename Container>
  void shuffle(Container& values) {
    for (std::size_t n = values.size(); n > 1; --n) {
      std::swap(values[n - 1],
                values[static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(n) - 1))]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pdsm::test
