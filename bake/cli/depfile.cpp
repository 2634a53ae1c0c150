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
    // make takes what follows for a command unless it is escaped, and ninja doesn't know the escape.
    if (c == ';') throw Error(Failure::usage, "--depfile", "can't hold a name with a semicolon");
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
  // A target's makes a pattern of it for make, and ninja doesn't know the escape.
  const auto has_percent = [](const std::filesystem::path& path) {
    return path.string().find('%') != std::string::npos;
  };
  if (has_percent(target))
    throw Error(Failure::usage, "--depfile", "can't be of an output with a percent sign in its name");
  std::string rule = escape(target) + ":", lone;
  for (const std::filesystem::path& input : inputs) {
    const std::string name = escape(input);
    rule += " \\\n  " + name;
    if (!has_percent(input)) lone += name + ":\n";
  }
  return rule + "\n" + lone;
}

}  // namespace pdsm
