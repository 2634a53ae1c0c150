// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Why a light has no frame.
enum class FrameFault { none, zero_direction, parallel_up };

/// What light_frame() would refuse. A direction or up that is zero, infinite or NaN counts as zero and
/// parallel respectively.
[[nodiscard]] FrameFault frame_fault(const Light& light);

}  // namespace pdsm
