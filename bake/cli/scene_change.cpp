// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_change.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "cli/inputs.h"
#include "cli/recorded_options.h"
#include "cli/streams.h"
#include "pdsm/bake/map_key.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

/// A string of the metadata; empty when there is none.
std::string text_at(const Json& metadata, const char* pointer) {
  const Json::json_pointer at(pointer);
  return metadata.contains(at) && metadata[at].is_string() ? metadata[at].get<std::string>() : "";
}

}  // namespace

bool changed_since_bake(const Scene& scene, const Light& light, const PenumbraMap& map) {
  const Json metadata = metadata_of(map);
  const std::string key = text_at(metadata, "/key"), isa = text_at(metadata, "/isa");
  std::optional<BakeOptions> options = recorded_options(map, light);
  if (key.empty() || isa.empty() || !options) return false;
  options->isa = isa;
  try {
    return map_key(scene, light, *options, text_at(metadata, "/tool/version")).key != key;
  } catch (const Error&) {
    return true;  // The scene can't be baked like that any more.
  }
}

void warn_if_changed(const Scene& scene, const Light& light, const PenumbraMap& map,
                     const std::string& map_name) {
  if (changed_since_bake(scene, light, map))
    write_warning(map_name + ": the scene has changed since the bake");
}

}  // namespace pdsm
