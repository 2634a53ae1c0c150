// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "pdsm/bake/bake.h"

namespace pdsm::bench {

/// A bake and what it took.
struct TimedBake {
  BakedMap baked;
  double seconds = 0;      ///< wall-clock
  double cpu_seconds = 0;  ///< of all threads together
  std::uint64_t file_bytes = 0, gpu_bytes = 0;
};

/// Bakes the scene's only light. The map is written to `scratch` to measure its file, and removed.
[[nodiscard]] TimedBake timed_bake(const Scene& scene, const Light& light, const BakeOptions& options,
                                   const std::filesystem::path& scratch);

}  // namespace pdsm::bench
