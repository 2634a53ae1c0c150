// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tile/bake_job.h"

namespace pdsm {

/// A hash of all that decides about the functions of a bake: version, instruction set, geometry, view, light
/// samples, and the options but for those that only decide how it is done (threads, tiles, memory). Bakes of
/// one identity have the same blocks. Where files lie and what else is in a scene has no say.
[[nodiscard]] std::uint64_t bake_identity(const Scene& scene, const BakeJob& job);

}  // namespace pdsm
