// SPDX-License-Identifier: Apache-2.0
#include "map_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/inputs.h"
#include "cli/scene_change.h"
#include "evaluate/map_statistics.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

/// A number of the map's own record; empty without it.
std::string recorded_number(const nlohmann::ordered_json& metadata, const char* key) {
  const auto value = metadata.find(key);
  return value != metadata.end() && value->is_number() ? fmt::format("{:.4g}", value->get<double>()) : "";
}

std::vector<Fact> map_facts(const LoadedMap& loaded) {
  const PenumbraMap& map = loaded.map;
  const View& view = map.views.front();
  const MapStatistics statistics = map_statistics(map);
  const nlohmann::ordered_json metadata = metadata_of(map);
  std::error_code unknown;
  const auto bytes = static_cast<double>(std::filesystem::file_size(loaded.path, unknown));
  const double empty = 100.0 * static_cast<double>(statistics.empty_texels) /
                       static_cast<double>(std::max<std::uint64_t>(1, statistics.texels));
  std::vector<Fact> facts{{"file", loaded.path.filename().string()},
                          {"size", unknown ? "" : fmt::format("{:.2f} MB", bytes / 1e6)},
                          {"texels", fmt::format("{} x {}, {:.0f}% empty", view.width, view.height, empty)},
                          {"depths", fmt::format("{:.2f} .. {:.2f} m", view.near_depth, view.far_depth)},
                          {"pieces", fmt::format("{}, at most {}", statistics.pieces,
                                                 statistics.longest > 0 ? statistics.longest - 1 : 0)},
                          {"light samples", map.samples.empty() ? "" : std::to_string(map.samples.size())},
                          {"fit tolerance", recorded_number(metadata, "epsilon")},
                          {"bias, m", recorded_number(metadata, "bias")}};
  std::erase_if(facts, [](const Fact& fact) { return fact.second.empty(); });
  return facts;
}

void note_change(const Scene& scene, const LoadedMap& loaded, Messages& messages) {
  if (!changed_since_bake(scene, scene.lights[loaded.light], loaded.map)) return;
  messages.note("warning: " + loaded.path.string() + ": the scene has changed since the bake");
}

}  // namespace

const LoadedMap* MapLibrary::of_light(std::size_t light) const {
  const auto found =
      std::find_if(maps_.begin(), maps_.end(), [light](const LoadedMap& map) { return map.light == light; });
  return found == maps_.end() ? nullptr : &*found;
}

LoadedMap MapLibrary::load(const std::filesystem::path& path, std::size_t index, const Scene& scene) const {
  LoadedMap loaded;
  loaded.path = path;
  // Looked at before it is read: what changes meanwhile is seen next time.
  loaded.signature = file_signature(path);
  loaded.map = read_map(path);
  loaded.light =
      static_cast<std::size_t>(&light_of_map(scene, loaded.map, index, path.string()) - scene.lights.data());
  loaded.facts = map_facts(loaded);
  return loaded;
}

void MapLibrary::add(const std::filesystem::path& path, const Scene& scene, bool replace,
                     Messages& messages) {
  LoadedMap loaded = load(path, maps_.size(), scene);
  const auto same_light = std::find_if(maps_.begin(), maps_.end(),
                                       [&](const LoadedMap& map) { return map.light == loaded.light; });
  if (same_light != maps_.end() && !replace) {
    throw Error(Failure::usage, path.string(),
                "is a second map of light '" + scene.lights[loaded.light].name + "'");
  }
  note_change(scene, loaded, messages);
  if (same_light != maps_.end()) {
    *same_light = std::move(loaded);
  } else {
    maps_.push_back(std::move(loaded));
  }
}

bool MapLibrary::refresh(const Scene& scene, Messages& messages) {
  bool any = false;
  for (std::size_t i = 0; i < maps_.size(); ++i) any = refresh_map(i, scene, messages) || any;
  return any;
}

bool MapLibrary::refresh_map(std::size_t index, const Scene& scene, Messages& messages) {
  LoadedMap& old = maps_[index];
  const std::optional<FileSignature> signature = file_signature(old.path);
  // A file that is gone may be about to be replaced.
  if (!signature || signature == old.signature) return false;
  old.signature = signature;
  try {
    LoadedMap loaded = load(old.path, old.light, scene);
    if (loaded.light != old.light) {
      throw Error(Failure::input, old.path.string() + ":light",
                  "is of light '" + scene.lights[loaded.light].name + "' now");
    }
    old = std::move(loaded);
  } catch (const Error& error) {
    messages.fault(std::string(error.what()) + "; the old map stays");
    return false;
  }
  messages.note(old.path.string() + ": read anew");
  note_change(scene, old, messages);
  return true;
}

}  // namespace pdsm
