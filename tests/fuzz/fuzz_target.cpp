// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "pdsm/format/error.h"

namespace pdsm::testing {

void demand(bool holds, std::string_view promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %.*s\n", static_cast<int>(promise.size()), promise.data());
  std::abort();
}

void demand_input_error() {
  try {
    throw;
  } catch (const Error& error) {
    const std::string what = error.what();
    demand(error.failure() == Failure::input, "the input is to blame, not: " + what);
    demand(what.find_first_of("\r\n") == std::string::npos, "a message of one line, not: " + what);
  } catch (const std::exception& error) {
    demand(false, std::string("no exception but Error, not: ") + error.what());
  }
}

}  // namespace pdsm::testing
