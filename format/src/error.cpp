// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/error.h"

#include <algorithm>

namespace pdsm {
namespace {

std::string without_controls(std::string text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text;
}

}  // namespace

Error::Error(Failure failure, const std::string& where, const std::string& reason)
    : std::runtime_error(without_controls(where.empty() ? reason : where + ": " + reason)),
      failure_(failure) {}

}  // namespace pdsm
