// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/option_values.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The options of a command line. What parses it is in command_line.cpp and options.cpp alone: its headers
/// take longer to compile than any command.
namespace pdsm {

/// One option, to say what it goes with.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required();
  Option needs(Option other);
  Option excludes(Option other);

 private:
  CLI::Option* option_;
};

/// What a command may be given. Targets must live until the command line is parsed, and keep their values
/// where an option is absent. Values are as strict as option_values.h says.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  /// `take` gets the text; `type` is what help calls it.
  Option value(const std::string& name, const std::string& type, std::function<void(const std::string&)> take,
               const std::string& help);

  Option text(const std::string& name, const std::string& type, std::string& target, const std::string& help);
  Option text(const std::string& name, const std::string& type, std::optional<std::string>& target,
              const std::string& help);

  /// One or more.
  Option texts(const std::string& name, const std::string& type, std::vector<std::string>& target,
               const std::string& help);

  Option flag(const std::string& name, bool& target, const std::string& help);

  /// A file that the command can't do without.
  Option file(const std::string& name, std::string& target, const std::string& help);

  /// A whole number; Target is an unsigned integer or an std::optional of one.
  template <typename Target>
  Option count(const std::string& name, Target& target, std::uint64_t low, std::uint64_t high,
               const std::string& help) {
    const auto take = [name, &target, low, high](const std::string& text) {
      using Value = std::conditional_t<std::is_integral_v<Target>, Target, std::uint32_t>;
      target = static_cast<Value>(parse_count(name, text, low, high));
    };
    return value(name, "N", take, with_range(help, static_cast<double>(low), static_cast<double>(high)));
  }

  /// A real number; Target is double or an std::optional of it.
  template <typename Target>
  Option real(const std::string& name, Target& target, double low, double high, const std::string& help) {
    const auto take = [name, &target, low, high](const std::string& text) {
      target = parse_real(name, text, low, high);
    };
    return value(name, "X", take, with_range(help, low, high));
  }

  /// A number of bytes, with K, M, G, T or without; Target is std::uint64_t or an std::optional of it.
  template <typename Target>
  Option memory(const std::string& name, Target& target, const std::string& help) {
    const auto take = [name, &target](const std::string& text) { target = parse_memory(name, text); };
    return value(name, "SIZE", take, help);
  }

  /// One of a few words.
  template <typename Target>
  Option choice(const std::string& name, Target& target,
                std::initializer_list<std::pair<std::string, Target>> choices, const std::string& help) {
    std::string words;
    for (const auto& [word, meaning] : choices) words += (words.empty() ? "" : "|") + word;
    const auto take = [name, words, &target, table = std::vector(choices)](const std::string& text) {
      for (const auto& [word, meaning] : table) {
        if (word != text) continue;
        target = meaning;
        return;
      }
      refuse_value(name, "one of " + words, text);
    };
    return value(name, words, take, help);
  }

 private:
  /// `help` with the range behind it, unless any number goes.
  [[nodiscard]] static std::string with_range(const std::string& help, double low, double high);

  CLI::App* app_;
};

}  // namespace pdsm
