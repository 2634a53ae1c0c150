// SPDX-License-Identifier: Apache-2.0
#include "markup.h"

#include <algorithm>
#include <regex>

namespace pdsm {
namespace {

/// Index behind the tag that begins at `begin`, quoted attributes skipped; npos when it has no end.
std::size_t end_of_tag(const std::string& text, std::size_t begin) {
  char quote = 0;
  for (std::size_t n = begin; n < text.size(); ++n) {
    const char c = text[n];
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return n + 1;
    } else if (c == '<' && n > begin) {
      return std::string::npos;
    }
  }
  return std::string::npos;
}

std::string name_of(const std::string& tag) {
  const std::size_t begin = tag.find_first_not_of("</");
  return tag.substr(begin, tag.find_first_of(" \t\r\n/>", begin) - begin);
}

}  // namespace

std::string find_markup_fault(const std::string& document, const std::vector<std::string>& void_elements) {
  std::vector<std::string> open;
  for (std::size_t at = document.find('<'); at != std::string::npos; at = document.find('<', at)) {
    const std::size_t end = end_of_tag(document, at);
    if (end == std::string::npos) return "no end: " + document.substr(at, 60);
    const std::string tag = document.substr(at, end - at), name = name_of(tag);
    at = end;
    if (tag[1] == '!' || tag[1] == '?' || tag.ends_with("/>")) continue;
    if (std::find(void_elements.begin(), void_elements.end(), name) != void_elements.end()) continue;
    if (tag[1] != '/') {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> in <" + (open.empty() ? "" : open.back()) + ">";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is left open";
}

std::string find_outside_reference(const std::string& document) {
  for (const char* words : {"<script", "@import", "<link", "<iframe"}) {
    if (document.find(words) != std::string::npos) return words;
  }
  // Pictures in the document and ids within it are all that may be named.
  static const std::regex reference(R"re((?:href|src|srcset|data|action)\s*=\s*["']?|url\(\s*["']?)re");
  for (std::sregex_iterator it(document.begin(), document.end(), reference), none; it != none; ++it) {
    const std::string target = it->suffix().str().substr(0, 32);
    if (!target.starts_with("data:") && !target.starts_with("#")) return it->str() + target;
  }
  return {};
}

}  // namespace pdsm
