// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "pdsm/bake/bake.h"

namespace pdsm {

/// The options by which `map` was baked for `light`, from its metadata and samples: bake() with them makes
/// its functions again. Neither the ISA, which may be another machine's, nor what has no effect on the bytes.
/// Empty when the metadata does not tell them all.
[[nodiscard]] std::optional<BakeOptions> recorded_options(const PenumbraMap& map, const Light& light);

}  // namespace pdsm
