// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pdsm {

/// Processor seconds that all threads of this process have taken so far. Any thread.
[[nodiscard]] double processor_seconds();

}  // namespace pdsm
