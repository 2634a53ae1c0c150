// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// The lights that --light `name` asks for: that one, or all. Throws Error: (usage) when the scene has none
/// of that name, (input) when it has none at all.
[[nodiscard]] std::vector<const Light*> chosen_lights(const Scene& scene,
                                                      const std::optional<std::string>& name);

/// The same where only one will do. Throws Error (usage) too when several are there and none is named.
[[nodiscard]] const Light& choose_light(const Scene& scene, const std::optional<std::string>& name);

/// A map's metadata; null when it is no JSON object, without what is nested deeper than any of ours.
[[nodiscard]] nlohmann::ordered_json metadata_of(const PenumbraMap& map);

/// Name of the light that a map was baked for, from its metadata; empty when it does not tell.
[[nodiscard]] std::string light_name_of(const PenumbraMap& map);

/// The scene's light for map number `index` of a command line: by the map's light name, else by order.
/// Throws Error (input) when there is none, or when it stands elsewhere now than when the map was baked.
[[nodiscard]] const Light& light_of_map(const Scene& scene, const PenumbraMap& map, std::size_t index,
                                        const std::string& map_name);

/// The scene file and the files that it names.
[[nodiscard]] std::vector<std::filesystem::path> scene_inputs(const std::filesystem::path& scene_file);

/// Checks an output before any work is done for it. Throws Error: (usage) when it is one of `inputs`, by
/// whatever path or link, (resource) when it can't be written.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

/// Whether two paths, of files that need not exist yet, are one.
[[nodiscard]] bool same_path(const std::filesystem::path& a, const std::filesystem::path& b);

/// All bytes of a regular file. Throws Error (input) "path: reason".
[[nodiscard]] std::vector<std::byte> read_bytes(const std::filesystem::path& path);

}  // namespace pdsm
