// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

/// What a level's bake made, for the engine that loads it: docs/manifest.schema.json.
namespace pdsm {

/// The name of the file beside the maps.
inline constexpr const char* kManifestName = "manifest.json";

enum class MapStatus {
  baked,    ///< the map is there, made now or before
  skipped,  ///< there is no map, as the light reaches nothing
  failed    ///< there is no map that is up to date
};

[[nodiscard]] const char* status_name(MapStatus status);

/// How far a map is from the truth, when it was measured.
struct MapError {
  double mean_abs_error = 0, p99_error = 0, max_error = 0;
  std::uint64_t points = 0, shadowed_points = 0;
};

/// One light of a level.
struct ManifestLight {
  Light light;
  MapStatus status = MapStatus::baked;
  std::string reason;        ///< why there is no map; else empty
  std::string file;          ///< relative to the manifest; empty without a map, as are all below
  std::uint64_t bytes = 0;   ///< of the file
  std::string key;           ///< map_key.h
  std::optional<View> view;  ///< of the map
  std::optional<MapError> error;
};

/// The manifest's text: the same for the same lights, with no times and no paths but the files'.
[[nodiscard]] std::string manifest_text(const std::vector<ManifestLight>& lights);

/// Writes it as a whole or not at all, unless the file holds just this already: then it is not touched.
/// Throws Error (resource).
void write_manifest(const std::vector<ManifestLight>& lights, const std::filesystem::path& path);

}  // namespace pdsm
