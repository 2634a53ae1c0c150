// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tile/bake_job.h"

namespace pdsm::bench {

/// Algorithm 3.1 of the thesis, as it would be written first: all texels of each sample's map traced, one
/// after the other scan-converted for each PDSM ray to far, events appended to a list a texel, lists sorted
/// in the end and summed up. No fit, no file. Needs samples in the light's plane; the exact walk. Returns the
/// events.
std::uint64_t bake_plainly(const BakeJob& job);

}  // namespace pdsm::bench
