// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace pdsm {

/// The one place where failures become exit codes. Prepares streams and interrupts, runs `run`, makes its
/// results arrive and returns its code; what it throws becomes one line on stderr and the code of its
/// failure.
[[nodiscard]] int guarded_main(const std::function<int()>& run);

}  // namespace pdsm
