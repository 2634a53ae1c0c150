// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/manifest.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>

#include "level/light_json.h"
#include "pdsm/bake/map_key.h"
#include "pdsm/format/atomic_file.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

/// To be raised when a key changes its meaning or goes.
constexpr int kManifestVersion = 1;

Json view_json(const View& view) {
  return {{"projection", view.projection == Projection::perspective ? "perspective" : "orthographic"},
          {"rotation", view.world_to_view.rotation},
          {"translation", view.world_to_view.translation},
          {"window", view.window},
          {"near", view.near_depth},
          {"far", view.far_depth},
          {"resolution", {view.width, view.height}}};
}

Json error_json(const MapError& error) {
  return {{"mean_abs_error", error.mean_abs_error},
          {"p99_error", error.p99_error},
          {"max_error", error.max_error},
          {"points", error.points},
          {"shadowed_points", error.shadowed_points}};
}

Json entry_json(const ManifestLight& entry) {
  Json json = light_json(entry.light);
  json["status"] = status_name(entry.status);
  if (!entry.reason.empty()) json["reason"] = entry.reason;
  if (entry.status != MapStatus::baked) return json;
  json["file"] = entry.file;
  json["bytes"] = entry.bytes;
  json["key"] = entry.key;
  if (entry.view) json["view"] = view_json(*entry.view);
  if (entry.error) json["error"] = error_json(*entry.error);
  return json;
}

bool holds(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  if (std::filesystem::file_size(path, error) != text.size() || error) return false;
  std::ifstream stream(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {}) == text;
}

}  // namespace

const char* status_name(MapStatus status) {
  switch (status) {
    case MapStatus::skipped:
      return "skipped";
    case MapStatus::failed:
      return "failed";
    case MapStatus::baked:
      break;
  }
  return "baked";
}

std::string manifest_text(const std::vector<ManifestLight>& lights) {
  Json json{{"manifest", kManifestVersion}, {"tool", {{"name", "pdsm"}, {"version", kToolVersion}}}};
  json["lights"] = Json::array();
  for (const ManifestLight& entry : lights) json["lights"].push_back(entry_json(entry));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_manifest(const std::vector<ManifestLight>& lights, const std::filesystem::path& path) {
  const std::string text = manifest_text(lights);
  if (holds(path, text)) return;
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

}  // namespace pdsm
