// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "scene/format_fault.h"
#include "scene/ply_header.h"

namespace pdsm {

/// The numbers of an ASCII PLY file, one after another; how they are spread over lines does not matter.
class AsciiPlyValues {
 public:
  explicit AsciiPlyValues(std::string_view bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  /// The least bytes that a number takes: a digit, and a space before the next.
  static std::size_t least_size(PlyType) { return 2; }
  /// Bytes left; one more, as the last number needs no space behind it.
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_) + 1; }

  /// The next number, whatever its type. Throws FormatFault if there is none.
  double next(PlyType type) {
    while (at_ != end_ && is_space(*at_)) ++at_;
    if (at_ == end_) throw FormatFault("the file ends");
    const char* begin = *at_ == '+' ? at_ + 1 : at_;
    double value = 0;
    std::from_chars_result parsed{};
    if (type < PlyType::float32) {
      std::int64_t whole = 0;
      parsed = std::from_chars(begin, end_, whole);
      value = static_cast<double>(whole);
    } else {
      parsed = std::from_chars(begin, end_, value);
      if (parsed.ec == std::errc::result_out_of_range) value = too_large_or_small(begin, parsed.ptr);
    }
    if (parsed.ec == std::errc::invalid_argument || (parsed.ptr != end_ && !is_space(*parsed.ptr))) {
      throw FormatFault("not a number");
    }
    at_ = parsed.ptr;
    return value;
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static double too_large_or_small(const char* begin, const char* end) {
    return std::string_view(begin, end).find("e-") != std::string_view::npos ||
                   std::string_view(begin, end).find("E-") != std::string_view::npos
               ? 0.0
               : std::numeric_limits<double>::infinity();
  }

  const char *at_, *end_;
};

/// The numbers of a binary PLY file.
class BinaryPlyValues {
 public:
  BinaryPlyValues(std::string_view bytes, PlyFormat format)
      : bytes_(bytes),
        swap_((format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)) {}

  static std::size_t least_size(PlyType type) { return size_of(type); }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }

 private:
  template <typename T>
  T take() {
    std::array<char, sizeof(T)> raw{};
    if (bytes_.size() < raw.size()) throw FormatFault("the file ends");
    std::memcpy(raw.data(), bytes_.data(), raw.size());
    bytes_.remove_prefix(raw.size());
    if (swap_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  std::string_view bytes_;
  bool swap_;
};

}  // namespace pdsm
