// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace pdsm {

/// The fields of one JSON object, read with checks. Every fault throws Error (input) "file:path.key: reason".
class JsonFields {
 public:
  /// `file` and `path` tell where the object is; throws if `node` is no object. `node` must outlive this.
  JsonFields(const nlohmann::json& node, std::string file, std::string path);

  /// Throws on any key that is not among `known`.
  void allow_only(std::initializer_list<std::string_view> known) const;

  [[nodiscard]] bool has(std::string_view key) const;
  /// The value, or null if there is none.
  [[nodiscard]] const nlohmann::json* find(std::string_view key) const;

  // All of these throw when the field is missing or of the wrong kind.
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] double positive(std::string_view key) const;
  [[nodiscard]] double not_negative(std::string_view key) const;
  /// From 0 to 1.
  [[nodiscard]] double share(std::string_view key) const;
  /// A number from 0 to 1 for all of red, green and blue, or one for each.
  [[nodiscard]] glm::dvec3 colour(std::string_view key) const;
  [[nodiscard]] glm::dvec3 vector(std::string_view key) const;
  [[nodiscard]] std::uint32_t count(std::string_view key, std::uint32_t most) const;
  /// An array, each element of which is then read by JsonFields or here.
  [[nodiscard]] const nlohmann::json& array(std::string_view key) const;

  /// Throws "file:path.key: reason".
  [[noreturn]] void refuse(std::string_view key, const std::string& reason) const;

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::string path_of(std::string_view key) const;

 private:
  [[nodiscard]] const nlohmann::json& require(std::string_view key) const;

  const nlohmann::json& node_;
  std::string file_, path_;
};

/// The number in `value` when it is one that a scene can hold: finite and at most 1e12 in size.
[[nodiscard]] bool is_scene_number(const nlohmann::json& value);

/// Whether `value` is an integer (512 or 512.0) from 1 to `most`.
[[nodiscard]] bool is_count(const nlohmann::json& value, std::uint32_t most);

}  // namespace pdsm
