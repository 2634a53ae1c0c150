// SPDX-License-Identifier: Apache-2.0
#include "cli/depfile.h"

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Backslashes before a character that takes one stand for themselves, and so are doubled.
std::string escape(const std::filesystem::path& path) {
  std::string text;
  std::size_t backslashes = 0;
  for (const char c : path.string()) {
    if (c == '\n' || c == '\r')
      throw Error(Failure::usage, "--depfile", "can't hold a name with a line break");
    if (c == '$') text += '$';
    if (c == ' ' || c == '\t' || c == '#' || c == ':') text += std::string(backslashes + 1, '\\');
    text += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return text;
}

}  // namespace

std::string depfile_text(const std::filesystem::path& target,
                         const std::vector<std::filesystem::path>& inputs) {
  std::string rule = escape(target) + ":", lone;
  for (const std::filesystem::path& input : inputs) {
    const std::string name = escape(input);
    rule += " \\\n  " + name;
    lone += name + ":\n";
  }
  return rule + "\n" + lone;
}

}  // namespace pdsm
