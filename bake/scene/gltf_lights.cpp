// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "light/light_axes.h"
#include "pdsm/format/error.h"
#include "scene/json_document.h"
#include "scene/json_fields.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

using nlohmann::json;

// As in JsonFields.
constexpr double kMaxCoordinate = 1e12;
// Half of the widest window that is chosen for a spot light's cone.
constexpr double kWidestConeAngle = std::numbers::pi / 3;
// What KHR_lights_punctual has for a spot light without one.
constexpr double kDefaultConeAngle = std::numbers::pi / 4;

json parsed(const std::string& text) {
  return text.empty() ? json() : json::parse(text);
}

const json* member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// A name that a light may have, as near to `name` as that goes.
std::string as_light_name(std::string name) {
  for (char& c : name) c = is_light_name_character(c) ? c : '_';
  return name;
}

/// Lights look along a node's -Z, with +Y up.
LightPlace place_of(const glm::dmat4& node_to_file) {
  return {glm::dvec3(node_to_file[3]), -glm::dvec3(node_to_file[2]), glm::dvec3(node_to_file[1])};
}

double largest_scale(const glm::dmat4& m) {
  return std::max(
      {glm::length(glm::dvec3(m[0])), glm::length(glm::dvec3(m[1])), glm::length(glm::dvec3(m[2]))});
}

/// What one node says of its light.
class LightNode {
 public:
  /// `file_extensions` are those of the whole file.
  LightNode(const tinygltf::Node& node, std::string name, const glm::dmat4& node_to_file,
            const json& file_extensions, const std::string& file, const std::string& path)
      : file_(file),
        path_(path),
        name_(std::move(name)),
        node_to_file_(node_to_file),
        extras_(parsed(node.extras_json_string)),
        extensions_(parsed(node.extensions_json_string)),
        file_extensions_(file_extensions) {}

  /// The light, or nothing; `left_out` then tells why, if there is one all the same.
  std::optional<Light> read(const EmissionReader& read_emission, std::string& left_out) const {
    if (const json* own = member(extras_, "pdsm_light")) {
      const JsonFields fields(*own, file_, path_ + ".extras.pdsm_light");
      return read_placed_light(fields, name_, place_of(node_to_file_), read_emission);
    }
    if (const json* use = member(extensions_, "EXT_lights_area")) return read_area(*use);
    if (const json* use = member(extensions_, "KHR_lights_punctual")) return read_punctual(*use, left_out);
    return std::nullopt;
  }

 private:
  /// The light of an extension's list that a node's extension object names.
  [[nodiscard]] JsonFields listed(const json& use, const std::string& extension) const {
    const JsonFields reference(use, file_, path_ + ".extensions." + extension);
    const json* index = reference.find("light");
    const json* list = member(file_extensions_, extension.c_str());
    const json* lights = list == nullptr ? nullptr : member(*list, "lights");
    const bool exists = index != nullptr && index->is_number_unsigned() && lights != nullptr &&
                        lights->is_array() && index->get<std::size_t>() < lights->size();
    if (!exists) reference.refuse("light", "must be the place of a light in the list of " + extension);
    const auto place = index->get<std::size_t>();
    return {(*lights)[place], file_, join_path("extensions." + extension + ".lights", place)};
  }

  /// A light of this shape, where the node is.
  [[nodiscard]] Light make(LightShape shape) const {
    Light light;
    light.name = name_;
    light.shape = shape;
    set_place(place_of(node_to_file_), light);
    return light;
  }

  [[nodiscard]] Light read_area(const json& use) const {
    const JsonFields fields = listed(use, "EXT_lights_area");
    const std::string type = fields.text("type");
    const double size = largest_scale(node_to_file_) * (fields.has("size") ? fields.positive("size") : 1);
    if (type == "disk") return make(DiskLight{size / 2});
    if (type != "rect") fields.refuse("type", "must be rect or disk");
    const json* rect = fields.find("rect");
    const double aspect = rect != nullptr && member(*rect, "aspect") != nullptr
                              ? JsonFields(*rect, file_, fields.path_of("rect")).positive("aspect")
                              : 1;
    return make(RectLight{size * aspect, size});
  }

  /// The extras of the light or else of the node, if they have `key`.
  [[nodiscard]] std::optional<JsonFields> extras_with(const JsonFields& light, const char* key) const {
    const json* own = light.find("extras");
    if (own != nullptr && member(*own, key) != nullptr)
      return JsonFields(*own, file_, light.path_of("extras"));
    if (member(extras_, key) != nullptr) return JsonFields(extras_, file_, path_ + ".extras");
    return std::nullopt;
  }

  /// A punctual light has no size: what casts soft shadows has one in its extras.
  [[nodiscard]] std::optional<Light> read_punctual(const json& use, std::string& left_out) const {
    const JsonFields fields = listed(use, "KHR_lights_punctual");
    const std::string type = fields.text("type");
    const bool distant = type == "directional";
    if (!distant && type != "spot" && type != "point")
      fields.refuse("type", "must be directional, point or spot");
    const char* key = distant ? "angle" : "radius";
    const std::optional<JsonFields> extras = extras_with(fields, key);
    if (!extras) {
      left_out = fmt::format("a {} light without {} in its extras", type, key);
      return std::nullopt;
    }
    if (distant) return make(DistantLight{read_distant_angle(*extras)});
    const double radius = extras->not_negative("radius");
    if (type == "point") return make(SphereLight{radius});
    Light light = make(DiskLight{radius});
    see_cone(fields, light);
    return light;
  }

  /// Lets the light's map hold a spot light's cone: by a window, or all that is in front of the light.
  void see_cone(const JsonFields& fields, Light& light) const {
    const json* spot = fields.find("spot");
    double angle = kDefaultConeAngle;
    if (spot != nullptr && member(*spot, "outerConeAngle") != nullptr)
      angle = JsonFields(*spot, file_, fields.path_of("spot")).positive("outerConeAngle");
    if (angle > kWidestConeAngle) {
      light.faces = 5;
      return;
    }
    const double t = std::tan(angle);
    light.window = std::array{-t, -t, t, t};
  }

  const std::string &file_, &path_;
  std::string name_;
  const glm::dmat4& node_to_file_;
  json extras_, extensions_;
  const json& file_extensions_;
};

/// A node may flatten its light, or move it out of all bounds.
bool has_place(const Light& light) {
  const glm::dvec3 p = glm::abs(light.position);
  return frame_fault(light) == FrameFault::none && std::max({p.x, p.y, p.z}) <= kMaxCoordinate;
}

}  // namespace

void GltfLights::take(const tinygltf::Model& model, std::size_t node, const glm::dmat4& node_to_file) {
  const tinygltf::Node& from = model.nodes[node];
  if (from.extras_json_string.empty() && from.extensions_json_string.empty()) return;
  if (!extensions_) extensions_ = parsed(model.extensions_json_string);
  std::string name = as_light_name(from.name), left_out;
  if (name.empty()) name = fmt::format("light{}", lights.size() + 1);
  const std::string path = join_path("nodes", node);
  const LightNode light_node(from, std::move(name), node_to_file, *extensions_, file_, path);
  const std::optional<Light> light = light_node.read(read_emission_, left_out);
  if (light) add(*light, path);
  if (!left_out.empty())
    warnings.push_back(fmt::format("{}: {} ({}): left out: {}", file_, path, one_line(from.name), left_out));
}

void GltfLights::add(const Light& light, const std::string& path) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(Failure::input, file_ + ":" + path, reason);
  };
  if (!has_place(light)) refuse("its transform leaves its light no direction or place");
  const auto [other, fresh] = node_of_.emplace(light.name, path);
  if (!fresh) refuse("its light's name, \"" + light.name + "\", is that of " + other->second + " too");
  lights.push_back(light);
}

}  // namespace pdsm
