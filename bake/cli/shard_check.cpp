// SPDX-License-Identifier: Apache-2.0
#include "cli/shard_check.h"

#include <nlohmann/json.hpp>
#include <string>

#include "cli/inputs.h"
#include "pdsm/bake/shard.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

/// The member that differs, as "options.seed"; empty where none does. The key, which differs with most
/// others, is named only where nothing else is.
std::string difference(const Json& ours, const Json& theirs) {
  if (!ours.is_object() || !theirs.is_object()) return {};
  std::string found;
  for (const auto& [name, value] : ours.items()) {
    const auto other = theirs.find(name);
    if (other != theirs.end() && *other == value) continue;
    const std::string inner = other == theirs.end() ? std::string() : difference(value, *other);
    found = inner.empty() ? name : name + "." + inner;
    if (found != "key") return found;
  }
  return found;
}

}  // namespace

void check_descriptions(std::span<const std::filesystem::path> shards) {
  const auto description = [](const std::filesystem::path& shard) {
    PenumbraMap map;
    map.metadata = read_shard_description(shard);
    return metadata_of(map);
  };
  const Json first = description(shards.front());
  for (const std::filesystem::path& shard : shards.subspan(1)) {
    const std::string field = difference(first, description(shard));
    if (field.empty()) continue;
    throw Error(Failure::input, shard.string() + ":" + field,
                "is of another bake: differs from " + shards.front().string());
  }
}

}  // namespace pdsm
