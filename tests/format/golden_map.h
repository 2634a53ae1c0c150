// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/format/penumbra_map.h"

namespace pdsm::testing {

/// The map in golden/, built number by number. Never to be changed: files of version 1 are out there.
[[nodiscard]] PenumbraMap golden_map();

}  // namespace pdsm::testing
