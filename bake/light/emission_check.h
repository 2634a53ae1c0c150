// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Why no light can have this picture; null where one can.
[[nodiscard]] const char* emission_fault(const EmissionImage& image);

/// Why this light can't have its picture, which any other could; null where it can.
[[nodiscard]] const char* emission_fault(const Light& light);

}  // namespace pdsm
