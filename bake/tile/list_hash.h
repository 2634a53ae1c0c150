// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pdsm {

/// A hash of a list of hashes, in their order, that can be made of the hashes of its parts: a list (h_1 ..
/// h_n) is the polynomial h_1 r^(n-1) + ... + h_n modulo the prime p = 2^61 - 1, once for each half of the
/// entries and a fixed r of its own. Lists that differ have different sums, unless what they differ by
/// happens to be 0: for entries that are random, a chance of 1 / p for either half, and so of 2^-122. That
/// holds for two entries that change places, too, as the powers of r differ: there are more than 2^57 of
/// them.
class ListHash {
 public:
  void add(const std::array<std::uint64_t, 2>& entry) {
    for (std::size_t n = 0; n < 2; ++n) sums_[n] = reduce(Wide{sums_[n]} * kFactors[n] + (entry[n] >> 3));
    ++count_;
  }
  /// Appends the list of `next`.
  void append(const ListHash& next) {
    for (std::size_t n = 0; n < 2; ++n)
      sums_[n] = reduce(Wide{sums_[n]} * power(kFactors[n], next.count_) + next.sums_[n]);
    count_ += next.count_;
  }

  [[nodiscard]] const std::array<std::uint64_t, 2>& sums() const { return sums_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  friend bool operator==(const ListHash&, const ListHash&) = default;

 private:
  __extension__ using Wide = unsigned __int128;

  static constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;
  /// Digits of pi and of e, below the prime.
  static constexpr std::array<std::uint64_t, 2> kFactors{0x03243F6A8885A308, 0x02B7E151628AED2A};

  static std::uint64_t reduce(Wide x) {
    // 2^61 = 1, so that the upper bits are added to the lower ones.
    const std::uint64_t sum = static_cast<std::uint64_t>(x & kPrime) + static_cast<std::uint64_t>(x >> 61);
    return sum >= kPrime ? sum - kPrime : sum;
  }
  static std::uint64_t power(std::uint64_t base, std::uint64_t exponent) {
    std::uint64_t result = 1;
    for (; exponent > 0; exponent >>= 1) {
      if ((exponent & 1) != 0) result = reduce(Wide{result} * base);
      base = reduce(Wide{base} * base);
    }
    return result;
  }

  std::array<std::uint64_t, 2> sums_{};
  std::uint64_t count_ = 0;
};

}  // namespace pdsm
