// SPDX-License-Identifier: Apache-2.0
#include "scene/json_document.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "pdsm/format/error.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

using nlohmann::json;

/// Levels of nesting that a document may have; ours have four.
constexpr std::size_t kDeepest = 64;

/// What the library says without its own error number and position.
std::string plain_reason(const std::string& what) {
  std::string text = what;
  if (const auto bracket = text.find("] "); text.starts_with('[') && bracket != std::string::npos) {
    text.erase(0, bracket + 2);
  }
  if (const auto colon = text.find(": "); text.starts_with("parse error at") && colon != std::string::npos) {
    text.erase(0, colon + 2);
  }
  return one_line(text);
}

/// Builds a document from parse events. The library's own builder keeps the last of two equal keys and
/// tells no line for numbers out of range; this one refuses both.
class DocumentBuilder : public nlohmann::json_sax<json> {
 public:
  DocumentBuilder(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  [[nodiscard]] json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    key_ = value;
    if (open_.back().node->contains(value)) {
      throw Error(Failure::input, name_ + ":" + join_path(open_.back().path, value), "is given twice");
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const json::exception& fault) override {
    // The last character read is the one at fault, so its own line end does not count.
    const auto read = static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + std::max<std::ptrdiff_t>(read - 1, 0), '\n');
    throw Error(Failure::input, name_ + ":" + std::to_string(line), plain_reason(fault.what()));
  }

 private:
  struct Level {
    json* node;
    std::string path;
  };

  /// Path of the value that comes next.
  [[nodiscard]] std::string next_path() const {
    if (open_.empty()) return "";
    const Level& level = open_.back();
    return level.node->is_array() ? join_path(level.path, level.node->size()) : join_path(level.path, key_);
  }

  json* place(json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    json& parent = *open_.back().node;
    if (parent.is_array()) return &parent.emplace_back(std::move(value));
    return &(parent[key_] = std::move(value));
  }

  bool add(json&& value) {
    place(std::move(value));
    return true;
  }

  bool open(json&& value) {
    std::string path = next_path();
    if (open_.size() == kDeepest) throw Error(Failure::input, name_ + ":" + path, "is nested too deeply");
    open_.push_back({place(std::move(value)), std::move(path)});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& text_;
  const std::string& name_;
  json root_;
  // Only the last child of an open array or object is open too, so these pointers stay valid.
  std::vector<Level> open_;
  std::string key_;
};

}  // namespace

bool is_nested_deeper(std::string_view text, std::size_t levels) {
  std::size_t open = 0;
  bool in_string = false;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char c = text[n];
    if (in_string && c == '\\') ++n;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if ((c == '[' || c == '{') && ++open > levels) return true;
    if ((c == ']' || c == '}') && open > 0) --open;
  }
  return false;
}

std::string join_path(const std::string& path, const std::string& key) {
  const std::string safe = one_line(key);
  return path.empty() ? safe : path + "." + safe;
}

std::string join_path(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

json parse_json(const std::string& text, const std::string& name) {
  DocumentBuilder builder(text, name);
  json::sax_parse(text, &builder, json::input_format_t::json, true, true);
  return builder.take();
}

}  // namespace pdsm
