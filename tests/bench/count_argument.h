// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

#include "pdsm/format/error.h"

namespace pdsm::bench {

/// Argument `n` of a program as a count from 1 on; `otherwise` where it is not given. Throws Error (usage)
/// for anything else.
inline std::uint32_t count_argument(int argc, char** argv, int n, std::uint32_t otherwise) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
  if (n >= argc) return otherwise;
  std::uint32_t value = 0;
  const char* end = argv[n] + std::strlen(argv[n]);
  const auto [stop, fault] = std::from_chars(argv[n], end, value);
  if (fault != std::errc() || stop != end || value == 0 || value > kMost) {
    throw Error(Failure::usage, argv[n], "is not a count of 1 or more");
  }
  return value;
}

}  // namespace pdsm::bench
