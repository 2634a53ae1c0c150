// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "evaluate/verify.h"
#include "tradeoff/settings.h"
#include "tradeoff/tube_check.h"

namespace pdsm {

/// What one bake of a sweep took and gave.
struct Measurement {
  TradeoffSetting setting;
  double seconds = 0;      ///< wall-clock: BVH, bake, writing the map; not loading the scene
  double cpu_seconds = 0;  ///< of all threads together, for the same: other work hardly changes it
  std::uint64_t rays = 0, events = 0, pieces = 0;
  std::uint64_t file_bytes = 0, gpu_bytes = 0;  ///< on disk; as the functions lie in textures
  VerifyResult error;
  TubeCheck tube;
};

/// One JSON object with every field; from_json() gives the measurement back bit for bit.
[[nodiscard]] nlohmann::ordered_json to_json(const Measurement& measurement);

/// Throws nlohmann::json::exception when a field is missing or of another type.
[[nodiscard]] Measurement measurement_of(const nlohmann::ordered_json& json);

}  // namespace pdsm
