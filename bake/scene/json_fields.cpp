// SPDX-License-Identifier: Apache-2.0
#include "scene/json_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pdsm/format/error.h"
#include "scene/json_document.h"

namespace pdsm {
namespace {

using nlohmann::json;

// Larger coordinates lose the shape of what is there, and their squares leave float.
constexpr double kMaxNumber = 1e12;

}  // namespace

JsonFields::JsonFields(const json& node, std::string file, std::string path)
    : node_(node), file_(std::move(file)), path_(std::move(path)) {
  if (!node_.is_object()) {
    throw Error(Failure::input, path_.empty() ? file_ : file_ + ":" + path_, "must be an object");
  }
}

void JsonFields::allow_only(std::initializer_list<std::string_view> known) const {
  for (const auto& [key, value] : node_.items()) {
    if (std::ranges::find(known, key) == known.end()) {
      refuse(key, fmt::format("unknown key; known are {}", fmt::join(known, ", ")));
    }
  }
}

bool JsonFields::has(std::string_view key) const {
  return find(key) != nullptr;
}

const json* JsonFields::find(std::string_view key) const {
  const auto found = node_.find(key);
  return found == node_.end() ? nullptr : &*found;
}

std::string JsonFields::path_of(std::string_view key) const {
  return join_path(path_, std::string(key));
}

void JsonFields::refuse(std::string_view key, const std::string& reason) const {
  throw Error(Failure::input, file_ + ":" + path_of(key), reason);
}

const json& JsonFields::require(std::string_view key) const {
  const json* value = find(key);
  if (value == nullptr) refuse(key, "is missing");
  return *value;
}

std::string JsonFields::text(std::string_view key) const {
  const json& value = require(key);
  if (!value.is_string()) refuse(key, "must be a string");
  return value.get<std::string>();
}

bool JsonFields::boolean(std::string_view key) const {
  const json& value = require(key);
  if (!value.is_boolean()) refuse(key, "must be true or false");
  return value.get<bool>();
}

double JsonFields::number(std::string_view key) const {
  const json& value = require(key);
  if (!value.is_number()) refuse(key, "must be a number");
  if (!is_scene_number(value)) refuse(key, fmt::format("must not exceed {:g} in size", kMaxNumber));
  return value.get<double>();
}

double JsonFields::positive(std::string_view key) const {
  const json& value = require(key);
  if (!value.is_number() || !(value.get<double>() > 0)) refuse(key, "must be a number > 0");
  return number(key);
}

double JsonFields::not_negative(std::string_view key) const {
  const json& value = require(key);
  if (!value.is_number() || !(value.get<double>() >= 0)) refuse(key, "must be a number >= 0");
  return number(key);
}

double JsonFields::share(std::string_view key) const {
  const double value = number(key);
  if (!(value >= 0 && value <= 1)) refuse(key, "must be a number from 0 to 1");
  return value;
}

glm::dvec3 JsonFields::colour(std::string_view key) const {
  const json& value = require(key);
  const auto is_share = [](const json& element) {
    return element.is_number() && element.get<double>() >= 0 && element.get<double>() <= 1;
  };
  if (is_share(value)) return glm::dvec3(value.get<double>());
  if (!value.is_array() || value.size() != 3 || !std::ranges::all_of(value, is_share))
    refuse(key, "must be a number from 0 to 1, or three of them: red, green and blue");
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

glm::dvec3 JsonFields::vector(std::string_view key) const {
  const json& value = require(key);
  const bool good = value.is_array() && value.size() == 3 &&
                    std::ranges::all_of(value, [](const json& element) { return element.is_number(); });
  if (!good) refuse(key, "must be [x,y,z], three numbers");
  if (!std::ranges::all_of(value, is_scene_number)) {
    refuse(key, fmt::format("must not exceed {:g} in size", kMaxNumber));
  }
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

std::uint32_t JsonFields::count(std::string_view key, std::uint32_t most) const {
  const json& value = require(key);
  if (!is_count(value, most)) refuse(key, fmt::format("must be an integer from 1 to {}", most));
  return static_cast<std::uint32_t>(value.get<double>());
}

const json& JsonFields::array(std::string_view key) const {
  const json& value = require(key);
  if (!value.is_array()) refuse(key, "must be an array");
  return value;
}

bool is_scene_number(const json& value) {
  // A comparison with NaN is false.
  return value.is_number() && std::abs(value.get<double>()) <= kMaxNumber;
}

bool is_count(const json& value, std::uint32_t most) {
  if (!value.is_number()) return false;
  const auto number = value.get<double>();
  return number >= 1 && number <= most && number == std::floor(number);
}

}  // namespace pdsm
