// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/scene_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "light/emission_check.h"
#include "pdsm/format/error.h"
#include "scene/emission_image.h"
#include "scene/file_source.h"
#include "scene/format_fault.h"
#include "scene/geometry_import.h"
#include "scene/gltf_lights.h"
#include "scene/json_document.h"
#include "scene/json_fields.h"
#include "scene/light_check.h"
#include "scene/one_line.h"
#include "scene/part_rules.h"
#include "scene/read_curves.h"
#include "scene/read_light.h"
#include "scene/read_placement.h"
#include "scene/read_volume.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A scene file names geometry, it does not hold it; a larger one is something else.
constexpr std::uint64_t kMaxSceneFileBytes = std::uint64_t{64} << 20;

/// Reads one scene, of a scene file or a glTF file; keeps what several of its entries share.
class SceneReader {
 public:
  explicit SceneReader(fs::path path) : path_(std::move(path)), file_(path_.string()) {}

  Scene read();

 private:
  void read_json();
  void read_gltf();
  void read_geometry(const json& node, std::size_t index);
  const ImportedFile& import(const JsonFields& fields);
  void read_lights(const json& nodes);
  template <typename Read>
  void read_each(const JsonFields& fields, const char* key, Read&& read_entry);
  std::shared_ptr<const EmissionImage> read_picture(const JsonFields& fields);
  std::vector<Geometry> read_placed(const JsonFields& fields);
  void warn_of(const ImportedFile& file, const std::string& name);

  fs::path path_;
  std::string file_;
  FileSource files_;
  std::map<fs::path, ImportedFile> imported_;
  Scene scene_;
};

const ImportedFile& SceneReader::import(const JsonFields& fields) {
  const std::string name = fields.text("file");
  if (name.empty() || name.find('\0') != std::string::npos) fields.refuse("file", "must name a file");
  const fs::path path = path_.parent_path() / fs::path(name);
  const auto known = imported_.find(path);
  if (known != imported_.end()) return known->second;
  try {
    ImportedFile file = import_file(files_, path);
    warn_of(file, name);
    return imported_.emplace(path, std::move(file)).first->second;
  } catch (const Error& fault) {
    throw Error(fault.failure(), file_ + ":" + fields.path_of("file"), fault.what());
  }
}

void SceneReader::warn_of(const ImportedFile& file, const std::string& name) {
  const std::string left_out = describe_left_out(file);
  if (!left_out.empty()) scene_.warnings.push_back(name + ": " + left_out);
  for (const std::string& warning : file.warnings) scene_.warnings.push_back(name + ":" + warning);
}

void SceneReader::read_geometry(const json& node, std::size_t index) {
  const JsonFields fields(node, file_, join_path("geometry", index));
  fields.allow_only(
      {"file", "scale", "rotate", "translate", "casts", "receives", "opacity", "transmission", "parts"});
  const glm::dmat4 placement = read_placement(fields);
  const bool casts = !fields.has("casts") || fields.boolean("casts");
  const bool receives = !fields.has("receives") || fields.boolean("receives");
  const double opacity = fields.has("opacity") ? fields.share("opacity") : 1;
  const ImportedFile& file = import(fields);
  std::vector<Geometry> parts = file.parts;
  place(parts, placement);
  for (Geometry& part : parts) {
    part.casts = casts;
    part.receives = receives;
    part.opacity *= opacity;
    if (fields.has("transmission")) part.transmission = fields.colour("transmission");
  }
  apply_part_rules(fields, file.names, parts);
  std::ranges::move(parts, std::back_inserter(scene_.geometry));
}

std::shared_ptr<const EmissionImage> SceneReader::read_picture(const JsonFields& fields) {
  const std::string name = fields.text("emission");
  if (name.empty() || name.find('\0') != std::string::npos) fields.refuse("emission", "must name a file");
  const fs::path path = path_.parent_path() / fs::path(name);
  try {
    auto image = read_emission(files_.read(path));
    if (const char* reason = emission_fault(*image)) throw FormatFault(reason);
    return image;
  } catch (const Error& fault) {
    throw Error(fault.failure(), fields.file() + ":" + fields.path_of("emission"), fault.what());
  } catch (const FormatFault& fault) {
    fields.refuse("emission", path.string() + ": " + one_line(fault.what()));
  }
}

/// The surfaces of a file, placed.
std::vector<Geometry> SceneReader::read_placed(const JsonFields& fields) {
  const glm::dmat4 placement = read_placement(fields);
  std::vector<Geometry> parts = import(fields).parts;
  if (parts.empty()) fields.refuse("file", "has no triangles");
  place(parts, placement);
  return parts;
}

void SceneReader::read_lights(const json& nodes) {
  std::map<std::string, std::size_t> names;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Light light = read_light(
        nodes[i], file_, i, [this](const JsonFields& fields) { return read_picture(fields); },
        [this](const JsonFields& fields) { return read_placed(fields); });
    const auto [other, fresh] = names.emplace(light.name, i);
    if (!fresh) {
      throw Error(Failure::input, file_ + ":" + join_path(join_path("lights", i), "name"),
                  "\"" + light.name + "\" is the name of " + join_path("lights", other->second) + " too");
    }
    scene_.lights.push_back(std::move(light));
  }
}

template <typename Read>
void SceneReader::read_each(const JsonFields& fields, const char* key, Read&& read_entry) {
  if (!fields.has(key)) return;
  const json& nodes = fields.array(key);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    read_entry({nodes[i], file_, join_path(key, i)}, path_.parent_path(), files_, scene_);
}

void SceneReader::read_json() {
  const json root = parse_json(files_.read(path_, kMaxSceneFileBytes), file_);
  const JsonFields fields(root, file_, "");
  fields.allow_only({"geometry", "volumes", "curves", "lights"});
  // Lights first: their faults are told before large files are read.
  if (fields.has("lights")) read_lights(fields.array("lights"));
  if (fields.has("geometry")) {
    const json& nodes = fields.array("geometry");
    for (std::size_t i = 0; i < nodes.size(); ++i) read_geometry(nodes[i], i);
  }
  read_each(fields, "volumes", read_volume);
  read_each(fields, "curves", read_curves);
}

void SceneReader::read_gltf() {
  GltfLights lights(file_, [this](const JsonFields& fields) { return read_picture(fields); });
  ImportedFile file = import_gltf(files_, unpacked_name(path_), files_.read_unpacked(path_), &lights);
  warn_of(file, path_.filename().string());
  scene_.geometry = std::move(file.parts);
  scene_.lights = std::move(lights.lights);
  std::ranges::move(lights.warnings, std::back_inserter(scene_.warnings));
}

Scene SceneReader::read() {
  scene_.source = file_;
  if (is_gltf_name(unpacked_name(path_)))
    read_gltf();
  else
    read_json();
  for (Light& light : scene_.lights) {
    place_distant_light(scene_, light);
    warn_if_inside(scene_, light);
  }
  scene_.content_hash = files_.content_hash();
  scene_.files = files_.files();
  return std::move(scene_);
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  return SceneReader(path).read();
}

}  // namespace pdsm
