// SPDX-License-Identifier: Apache-2.0
#include "cli/option_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// The number that `text` wholly is.
template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// log2 of the unit that a size ends with, taken off `text`.
int take_unit(std::string_view& text) {
  constexpr std::string_view kUnits = "KMGT";
  if (text.empty()) return 0;
  const std::size_t unit = kUnits.find(text.back());
  if (unit == std::string_view::npos) return 0;
  text.remove_suffix(1);
  return 10 * static_cast<int>(unit + 1);
}

}  // namespace

void refuse_value(const std::string& option, const std::string& must_be, const std::string& text) {
  throw Error(Failure::usage, option, fmt::format("must be {}, not '{}'", must_be, text));
}

std::uint64_t parse_count(const std::string& option, const std::string& text, std::uint64_t low,
                          std::uint64_t high) {
  const auto value = whole_number<std::uint64_t>(text);
  if (!value || *value < low || *value > high) {
    refuse_value(option, fmt::format("a whole number {} .. {}", low, high), text);
  }
  return *value;
}

double parse_real(const std::string& option, const std::string& text, double low, double high) {
  const auto value = whole_number<double>(text);
  if (!value || !(*value >= low && *value <= high)) {
    refuse_value(option, fmt::format("a number {} .. {}", low, high), text);
  }
  return *value;
}

std::array<std::uint32_t, 2> parse_size(const std::string& option, const std::string& text,
                                        std::uint32_t most) {
  const std::size_t cross = text.find('x');
  const auto width = whole_number<std::uint32_t>(std::string_view(text).substr(0, cross));
  const auto height = cross == std::string::npos
                          ? width
                          : whole_number<std::uint32_t>(std::string_view(text).substr(cross + 1));
  const auto fits = [most](const std::optional<std::uint32_t>& n) { return n && *n >= 1 && *n <= most; };
  if (!fits(width) || !fits(height)) refuse_value(option, fmt::format("R or WxH, each 1 .. {}", most), text);
  return {*width, *height};
}

std::uint64_t parse_memory(const std::string& option, const std::string& text) {
  constexpr double kMostBytes = 0x1p60;
  std::string_view digits = text;
  const int unit = take_unit(digits);
  const auto value = whole_number<double>(digits);
  const double bytes = value ? std::ldexp(*value, unit) : 0;
  if (!(bytes >= 1 && bytes <= kMostBytes)) {
    refuse_value(option, "a size such as 268435456, 256M or 4G", text);
  }
  return static_cast<std::uint64_t>(bytes);
}

}  // namespace pdsm
