// SPDX-License-Identifier: Apache-2.0
#include "json_schema.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace pdsm {
namespace {

using Json = nlohmann::json;

class SchemaCheck {
 public:
  explicit SchemaCheck(const Json& root) : root_(root) {}

  [[nodiscard]] std::string fault(const Json& schema, const Json& value, const std::string& where) const {
    for (const auto& [keyword, rule] : schema.items()) {
      const std::string found = fault_of(keyword, rule, schema, value, where);
      if (!found.empty()) return found;
    }
    return {};
  }

 private:
  [[nodiscard]] std::string fault_of(const std::string& keyword, const Json& rule, const Json& schema,
                                     const Json& value, const std::string& where) const {
    const auto require = [&](bool holds) { return holds ? std::string() : where + ": " + keyword; };
    if (keyword == "title" || keyword == "description" || keyword == "$schema" || keyword == "$defs")
      return {};
    if (keyword == "$ref")
      return fault(root_.at(Json::json_pointer(rule.get<std::string>().substr(1))), value, where);
    if (keyword == "type") return require(has_type(rule.get<std::string>(), value));
    if (keyword == "const") return require(value == rule);
    if (keyword == "enum") return require(std::ranges::find(rule, value) != rule.end());
    if (keyword == "minimum") return require(value >= rule);
    if (keyword == "minItems") return require(value.size() >= rule.get<std::size_t>());
    if (keyword == "maxItems") return require(value.size() <= rule.get<std::size_t>());
    if (keyword == "pattern")
      return require(std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
    if (keyword == "required")
      return require(
          std::ranges::all_of(rule, [&](const Json& key) { return value.contains(key.get<std::string>()); }));
    if (keyword == "items") return fault_of_items(rule, value, where);
    if (keyword == "properties") return fault_of_properties(rule, value, where);
    if (keyword == "additionalProperties") return fault_of_others(schema, value, where);
    throw std::invalid_argument(keyword);
  }

  static bool has_type(const std::string& type, const Json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    throw std::invalid_argument(type);
  }

  [[nodiscard]] std::string fault_of_items(const Json& rule, const Json& value,
                                           const std::string& where) const {
    for (std::size_t n = 0; n < value.size(); ++n) {
      const std::string found = fault(rule, value[n], where + "[" + std::to_string(n) + "]");
      if (!found.empty()) return found;
    }
    return {};
  }

  [[nodiscard]] std::string fault_of_properties(const Json& rule, const Json& value,
                                                const std::string& where) const {
    for (const auto& [key, of_key] : rule.items()) {
      if (!value.contains(key)) continue;
      const std::string found = fault(of_key, value[key], where + "." + key);
      if (!found.empty()) return found;
    }
    return {};
  }

  [[nodiscard]] static std::string fault_of_others(const Json& schema, const Json& value,
                                                   const std::string& where) {
    for (const auto& [key, unused] : value.items()) {
      if (!schema.at("properties").contains(key)) return where + "." + key + ": is not known";
    }
    return {};
  }

  const Json& root_;
};

}  // namespace

std::string schema_fault(const Json& schema, const Json& value) {
  return SchemaCheck(schema).fault(schema, value, "");
}

}  // namespace pdsm
