// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

/// Plain-old-data to bytes and back, and arithmetic that notices overflow. Files are little-endian.
namespace pdsm {

static_assert(std::endian::native == std::endian::little, "files are written as they lie in memory");

/// product = a * b; false where it does not fit 64 bits.
[[nodiscard]] inline bool checked_multiply(std::uint64_t a, std::uint64_t b, std::uint64_t& product) {
  return !__builtin_mul_overflow(a, b, &product);
}

/// sum += a * b; false where either step does not fit 64 bits.
[[nodiscard]] inline bool checked_add_product(std::uint64_t a, std::uint64_t b, std::uint64_t& sum) {
  std::uint64_t product = 0;
  return checked_multiply(a, b, product) && !__builtin_add_overflow(sum, product, &sum);
}

/// Appends the bytes of all elements.
template <typename T>
void append_array(std::vector<std::byte>& bytes, std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (values.empty()) return;
  const std::size_t position = bytes.size();
  bytes.resize(position + values.size_bytes());
  std::memcpy(bytes.data() + position, values.data(), values.size_bytes());
}

/// Appends the bytes of `value`.
template <typename T>
void append_value(std::vector<std::byte>& bytes, const T& value) {
  append_array(bytes, std::span(&value, 1));
}

/// Reads forward through bytes of unknown origin; a read past the end yields zeros and clears ok().
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename T>
  [[nodiscard]] T value() {
    T result{};
    array(std::span<T>(&result, 1));
    return result;
  }

  template <typename T>
  void array(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    ok_ = ok_ && remaining() >= values.size_bytes();
    if (!ok_ || values.empty()) return;
    std::memcpy(values.data(), bytes_.data() + position_, values.size_bytes());
    position_ += values.size_bytes();
  }

  void skip(std::size_t count) {
    ok_ = ok_ && remaining() >= count;
    if (ok_) position_ += count;
  }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - position_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace pdsm
