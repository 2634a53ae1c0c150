// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "pdsm/bake/map_key.h"
#include "pdsm/format/map_file.h"

namespace pdsm {

std::optional<std::string> recorded_key(const std::filesystem::path& path) {
  using Json = nlohmann::json;
  const std::optional<std::string> metadata = read_metadata(path);
  if (!metadata) return std::nullopt;
  // The key lies at the top; what is nested may be anything.
  const auto keep = [](int depth, Json::parse_event_t, Json&) { return depth <= 1; };
  const Json json = Json::parse(*metadata, keep, false);
  const auto key = json.is_object() ? json.find("key") : json.end();
  if (key == json.end() || !key->is_string()) return std::nullopt;
  return key->get<std::string>();
}

}  // namespace pdsm
