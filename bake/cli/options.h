// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

#include "pdsm/format/error.h"

/// Options with strict values. A value that is not wholly what it should be, or out of range, throws Error
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

/// A file that the command can't do without.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& target, const std::string& help);

/// `help` with the range behind it, unless any number goes.
[[nodiscard]] std::string help_with_range(const std::string& help, double low, double high);

/// A whole-number option; Target is an unsigned integer or an std::optional of one.
template <typename Target>
CLI::Option* add_count(CLI::App& app, const std::string& name, Target& target, std::uint64_t low,
                       std::uint64_t high, const std::string& help) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target, low, high](const std::string& text) {
            using Value = std::conditional_t<std::is_integral_v<Target>, Target, std::uint32_t>;
            target = static_cast<Value>(parse_count(name, text, low, high));
          },
          help_with_range(help, static_cast<double>(low), static_cast<double>(high)))
      ->type_name("N");
}

/// A real-number option; Target is double or an std::optional of it.
template <typename Target>
CLI::Option* add_real(CLI::App& app, const std::string& name, Target& target, double low, double high,
                      const std::string& help) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target, low, high](const std::string& text) { target = parse_real(name, text, low, high); },
          help_with_range(help, low, high))
      ->type_name("X");
}

/// An option that takes one of a few words.
template <typename Target>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Target& target,
                        std::initializer_list<std::pair<std::string, Target>> choices,
                        const std::string& help) {
  std::string words;
  for (const auto& [word, value] : choices) words += (words.empty() ? "" : "|") + word;
  return app
      .add_option_function<std::string>(
          name,
          [name, words, &target, table = std::vector(choices)](const std::string& text) {
            for (const auto& [word, value] : table) {
              if (word != text) continue;
              target = value;
              return;
            }
            refuse_value(name, "one of " + words, text);
          },
          help)
      ->type_name(words);
}

}  // namespace pdsm
