// SPDX-License-Identifier: Apache-2.0
#include "scene/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "scene/format_fault.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames{{{"char", PlyType::int8},
                                                                           {"int8", PlyType::int8},
                                                                           {"uchar", PlyType::uint8},
                                                                           {"uint8", PlyType::uint8},
                                                                           {"short", PlyType::int16},
                                                                           {"int16", PlyType::int16},
                                                                           {"ushort", PlyType::uint16},
                                                                           {"uint16", PlyType::uint16},
                                                                           {"int", PlyType::int32},
                                                                           {"int32", PlyType::int32},
                                                                           {"uint", PlyType::uint32},
                                                                           {"uint32", PlyType::uint32},
                                                                           {"float", PlyType::float32},
                                                                           {"float32", PlyType::float32},
                                                                           {"double", PlyType::float64},
                                                                           {"float64", PlyType::float64}}};

// Longer lines are not a header's.
constexpr std::size_t kMaxLine = 4096;

/// Goes through the lines of a header and says in which one a fault is.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view bytes) : bytes_(bytes) {}

  PlyHeader parse() {
    if (next_line() != std::vector<std::string_view>{"ply"}) refuse("must be \"ply\"");
    bool has_format = false;
    for (;;) {
      const std::vector<std::string_view> words = next_line();
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        read_format(words);
        has_format = true;
      } else if (words[0] == "element") {
        read_element(words);
      } else if (words[0] == "property") {
        read_property(words);
      } else {
        refuse("unknown keyword " + one_line(words[0]));
      }
    }
    if (!has_format) refuse("the header names no format");
    header_.size = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw FormatFault(fmt::format("line {}: {}", line_, reason));
  }

  /// The words of the next line. A binary file's rows begin right behind the line end of end_header.
  std::vector<std::string_view> next_line() {
    ++line_;
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos || end - at_ > kMaxLine) refuse("the header does not end");
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    std::vector<std::string_view> words;
    while (!line.empty()) {
      const std::size_t begin = line.find_first_not_of(" \t\r");
      if (begin == std::string_view::npos) break;
      line.remove_prefix(begin);
      const std::size_t size = std::min(line.find_first_of(" \t\r"), line.size());
      words.push_back(line.substr(0, size));
      line.remove_prefix(size);
    }
    return words;
  }

  void read_format(const std::vector<std::string_view>& words) {
    const std::string_view name = words.size() == 3 ? words[1] : "";
    if (name == "ascii")
      header_.format = PlyFormat::ascii;
    else if (name == "binary_little_endian")
      header_.format = PlyFormat::little_endian;
    else if (name == "binary_big_endian")
      header_.format = PlyFormat::big_endian;
    else
      refuse("unknown format");
  }

  void read_element(const std::vector<std::string_view>& words) {
    PlyElement element;
    if (words.size() != 3) refuse("must be: element NAME COUNT");
    element.name = words[1];
    const auto [end, fault] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (fault != std::errc{} || end != words[2].data() + words[2].size())
      refuse("must be: element NAME COUNT");
    header_.elements.push_back(std::move(element));
  }

  void read_property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) refuse("a property before any element");
    PlyProperty property;
    if (words.size() == 5 && words[1] == "list") {
      property = {std::string(words[4]), type_of(words[3]), type_of(words[2])};
      if (*property.count_type >= PlyType::float32) refuse("a list's length must be an integer");
    } else if (words.size() == 3) {
      property = {std::string(words[2]), type_of(words[1]), std::nullopt};
    } else {
      refuse("must be: property TYPE NAME, or property list TYPE TYPE NAME");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  [[nodiscard]] PlyType type_of(std::string_view name) const {
    for (const auto& [known, type] : kTypeNames) {
      if (known == name) return type;
    }
    refuse("unknown type " + one_line(name));
  }

  std::string_view bytes_;
  std::size_t at_ = 0, line_ = 0;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 8;
}

PlyHeader parse_ply_header(std::string_view bytes) {
  return HeaderParser(bytes).parse();
}

}  // namespace pdsm
