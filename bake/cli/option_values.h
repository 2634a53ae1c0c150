// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

/// What options' values mean. A value that is not wholly what it should be, or out of range, throws Error
/// (usage) "--option: reason". Independent of the locale.
namespace pdsm {

/// The highest numbers of samples and texels that options take.
inline constexpr std::uint32_t kMostSamples = 65536, kMostTexels = 16384;

/// A whole number low .. high.
[[nodiscard]] std::uint64_t parse_count(const std::string& option, const std::string& text, std::uint64_t low,
                                        std::uint64_t high);

/// A finite number low .. high.
[[nodiscard]] double parse_real(const std::string& option, const std::string& text, double low, double high);

/// "R" or "WxH", each 1 .. most.
[[nodiscard]] std::array<std::uint32_t, 2> parse_size(const std::string& option, const std::string& text,
                                                      std::uint32_t most);

/// Bytes: a number > 0 with K, M, G or T (powers of 1024) or without.
[[nodiscard]] std::uint64_t parse_memory(const std::string& option, const std::string& text);

/// Throws Error (usage) that says what `option` must be and what it is.
[[noreturn]] void refuse_value(const std::string& option, const std::string& must_be,
                               const std::string& text);

}  // namespace pdsm
