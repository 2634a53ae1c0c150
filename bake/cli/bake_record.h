// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "choose/search.h"
#include "pdsm/bake/bake.h"

/// What is written down about a bake: in the map for good, in the report for those who run it.
namespace pdsm {

/// The metadata of a baked map. Holds nothing that may change while its key stays (pdsm/bake/map_key.h): no
/// times, threads or tiles, and nothing of what the light does not see. `chosen` and `asked` (job_key.h) are
/// null unless the bake had goals.
[[nodiscard]] std::string bake_metadata(const Light& light, const BakeOptions& options, const BakedMap& baked,
                                        const ChosenBake* chosen = nullptr,
                                        const nlohmann::ordered_json& asked = nullptr);

/// What the command line knows beyond the baker's own report.
struct BakeCosts {
  double seconds_load = 0, seconds_write = 0;
  std::uint64_t file_bytes = 0;
};

/// The report of one bake (docs/commands.md).
[[nodiscard]] nlohmann::ordered_json bake_report(const BakeOptions& options, const BakedMap& baked,
                                                 const BakeCosts& costs, const ChosenBake* chosen = nullptr);

/// The metadata of `map` with what was modelled as the report has it now. Throws Error (input) where they are
/// no JSON object.
[[nodiscard]] std::string with_modelled(const PenumbraMap& map, const BakeReport& report);

/// Writes a report, as a whole or not at all.
void write_report(const std::filesystem::path& path, const nlohmann::ordered_json& report);

[[nodiscard]] const char* walk_name(Walk walk);

/// Most memory that this process had resident so far, bytes; 0 where the system does not tell.
[[nodiscard]] std::uint64_t peak_memory();

}  // namespace pdsm
