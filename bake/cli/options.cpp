// SPDX-License-Identifier: Apache-2.0
#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace pdsm {

Option Option::required() {
  option_->required();
  return *this;
}

Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Options::value(const std::string& name, const std::string& type,
                      std::function<void(const std::string&)> take, const std::string& help) {
  return Option(*app_->add_option_function<std::string>(name, std::move(take), help)->type_name(type));
}

Option Options::text(const std::string& name, const std::string& type, std::string& target,
                     const std::string& help) {
  return Option(*app_->add_option(name, target, help)->type_name(type));
}

Option Options::text(const std::string& name, const std::string& type, std::optional<std::string>& target,
                     const std::string& help) {
  return value(
      name, type, [&target](const std::string& text) { target = text; }, help);
}

Option Options::texts(const std::string& name, const std::string& type, std::vector<std::string>& target,
                      const std::string& help) {
  return Option(*app_->add_option(name, target, help)->type_name(type));
}

Option Options::flag(const std::string& name, bool& target, const std::string& help) {
  return Option(*app_->add_flag(name, target, help));
}

Option Options::file(const std::string& name, std::string& target, const std::string& help) {
  return text(name, "", target, help).required();
}

std::string Options::with_range(const std::string& help, double low, double high) {
  constexpr double kAny = 0x1p63;
  return high >= kAny ? help : fmt::format("{} ({:.6g} .. {:.6g})", help, low, high);
}

}  // namespace pdsm
