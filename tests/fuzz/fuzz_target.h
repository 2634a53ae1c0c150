// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// What the fuzz targets share. A target is one function with libFuzzer's name that takes any bytes; it ends
/// the process where a promise is broken, which libFuzzer, the sanitizers and ctest all see.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace pdsm::testing {

/// Prints `promise` and aborts unless it holds. Not an assert: it has to survive NDEBUG.
void demand(bool holds, std::string_view promise);

/// Ends the process unless the exception being handled is an Error of one line that blames the input.
void demand_input_error();

/// Runs `read`, which may refuse hostile bytes by such an Error and nothing else. Returns whether it came
/// through.
template <typename Read>
bool refused_or_read(Read&& read) {
  try {
    read();
    return true;
  } catch (...) {
    demand_input_error();
    return false;
  }
}

}  // namespace pdsm::testing
