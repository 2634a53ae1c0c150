// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace pdsm {

/// A fault inside a geometry file: what() says where in it and what. Its reader adds the file's name.
struct FormatFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pdsm
