// SPDX-License-Identifier: Apache-2.0
#include "cli/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/streams.h"
#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

/// Every string anywhere in a JSON document.
void append_strings(const nlohmann::json& json, std::vector<std::string>& strings) {
  if (json.is_string()) strings.push_back(json.get<std::string>());
  if (!json.is_structured()) return;
  for (const nlohmann::json& child : json) append_strings(child, strings);
}

/// Files that a JSON file names, whatever its schema; none when it is no JSON.
std::vector<fs::path> named_files(const fs::path& json_file) {
  std::ifstream stream(json_file, std::ios::binary);
  // What is nested deeper than any scene's file names is left out before it can overflow the stack.
  constexpr int kDeepest = 64;
  const auto keep = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    return depth <= kDeepest;
  };
  const nlohmann::json json = nlohmann::json::parse(stream, keep, false, true);
  std::vector<std::string> strings;
  append_strings(json, strings);
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const std::string& text : strings) {
    const fs::path path = json_file.parent_path() / text;
    if (!text.empty() && fs::is_regular_file(path, ignored)) files.push_back(path);
  }
  return files;
}

}  // namespace

std::vector<const Light*> chosen_lights(const Scene& scene, const std::optional<std::string>& name) {
  if (scene.lights.empty()) throw Error(Failure::input, scene.source + ":lights", "the scene has no light");
  std::vector<const Light*> lights;
  for (const Light& light : scene.lights) {
    if (!name || light.name == *name) lights.push_back(&light);
  }
  if (lights.empty()) throw Error(Failure::usage, "--light", "the scene has no light '" + *name + "'");
  return lights;
}

const Light& choose_light(const Scene& scene, const std::optional<std::string>& name) {
  const std::vector<const Light*> lights = chosen_lights(scene, name);
  if (lights.size() > 1) throw Error(Failure::usage, "--light", "the scene has several lights: name one");
  return *lights.front();
}

nlohmann::ordered_json metadata_of(const PenumbraMap& map) {
  using Json = nlohmann::ordered_json;
  // A file of unknown origin may nest until printing overflows the stack.
  constexpr int kDeepest = 16;
  const auto keep = [](int depth, Json::parse_event_t, Json&) { return depth <= kDeepest; };
  Json metadata = Json::parse(map.metadata, keep, false);
  return metadata.is_object() ? metadata : Json();
}

std::string light_name_of(const PenumbraMap& map) {
  const nlohmann::ordered_json metadata = metadata_of(map);
  const nlohmann::ordered_json::json_pointer name("/light/name");
  if (!metadata.contains(name) || !metadata[name].is_string()) return {};
  return metadata[name].get<std::string>();
}

namespace {

const Light& named_light(const Scene& scene, const PenumbraMap& map, std::size_t index,
                         const std::string& map_name) {
  const std::string name = light_name_of(map);
  for (const Light& light : scene.lights) {
    if (light.name == name) return light;
  }
  if (!name.empty()) {
    throw Error(Failure::input, map_name + ":light", "the scene has no light '" + name + "'");
  }
  if (index >= scene.lights.size()) {
    throw Error(Failure::input, map_name + ":light", "names no light, and the scene has no further one");
  }
  return scene.lights[index];
}

/// Whether two frames of `light` differ by no more than what rounding makes of the same numbers. A distant
/// light's space may begin anywhere.
bool same_frame(const Light& light, const RigidTransform& a, const RigidTransform& b) {
  constexpr double kRounding = 1e-9;
  const auto near = [](double x, double y) {
    return std::abs(x - y) <= kRounding * std::max({1.0, std::abs(x), std::abs(y)});
  };
  return std::equal(a.rotation.begin(), a.rotation.end(), b.rotation.begin(), near) &&
         (is_distant(light) ||
          std::equal(a.translation.begin(), a.translation.end(), b.translation.begin(), near));
}

}  // namespace

const Light& light_of_map(const Scene& scene, const PenumbraMap& map, std::size_t index,
                          const std::string& map_name) {
  const Light& light = named_light(scene, map, index, map_name);
  if (!same_frame(light, map.views.front().world_to_view, light_frame(light))) {
    throw Error(Failure::input, map_name + ":light",
                "was baked for another position or direction of light '" + light.name + "'");
  }
  return light;
}

std::vector<fs::path> scene_inputs(const fs::path& scene_file) {
  std::vector<fs::path> inputs{scene_file};
  std::error_code ignored;
  // FIFOs and the like are left for the reader to refuse.
  if (!fs::is_regular_file(scene_file, ignored)) return inputs;
  const std::vector<fs::path> named = named_files(scene_file);
  inputs.insert(inputs.end(), named.begin(), named.end());
  for (const fs::path& file : named) {
    if (file.extension() != ".gltf") continue;
    const std::vector<fs::path> buffers = named_files(file);
    inputs.insert(inputs.end(), buffers.begin(), buffers.end());
  }
  return inputs;
}

void check_output(const fs::path& output, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs) {
    std::error_code missing;
    if (fs::equivalent(output, input, missing)) {
      throw Error(Failure::usage, output.string(), "is an input, and would be overwritten");
    }
  }
  const AtomicFile probe(output);
}

bool same_path(const fs::path& a, const fs::path& b) {
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

std::vector<std::byte> read_bytes(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error) throw Error(Failure::input, path.string(), error.message());
  if (!fs::is_regular_file(status)) throw Error(Failure::input, path.string(), "is not a regular file");
  std::ifstream stream(path, std::ios::binary);
  std::vector<std::byte> bytes(fs::file_size(path, error));
  if (!error && stream) {
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  if (error || !stream) throw Error(Failure::input, path.string(), "can't be read");
  return bytes;
}

}  // namespace pdsm
