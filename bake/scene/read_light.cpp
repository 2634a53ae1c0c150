// SPDX-License-Identifier: Apache-2.0
#include "scene/read_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/emission_check.h"
#include "light/light_axes.h"
#include "scene/json_document.h"
#include "scene/json_fields.h"

namespace pdsm {
namespace {

using nlohmann::json;

// As in BakeOptions.
constexpr std::uint32_t kMaxResolution = 16384;
constexpr std::uint32_t kMaxSamples = 65536;
// A wider window spends its texels on grazing light.
constexpr double kMaxFov = 120;

/// The light's shape by its type; throws unless every key belongs to a light of that type.
LightShape read_shape(const JsonFields& fields) {
  const std::string type = fields.text("type");
  if (type == "rect") {
    fields.allow_only({"name", "type", "position", "direction", "up", "width", "height", "fov", "window",
                       "near", "far", "faces", "two_sided", "emission", "resolution", "samples"});
    return RectLight{fields.not_negative("width"), fields.not_negative("height")};
  }
  if (type == "disk") {
    fields.allow_only({"name", "type", "position", "direction", "up", "radius", "fov", "window", "near",
                       "far", "faces", "two_sided", "emission", "resolution", "samples"});
    return DiskLight{fields.not_negative("radius")};
  }
  if (type == "distant") {
    fields.allow_only(
        {"name", "type", "direction", "up", "angle", "window", "near", "far", "resolution", "samples"});
    return DistantLight{fields.has("angle") ? read_distant_angle(fields) : DistantLight{}.angle};
  }
  if (type == "sphere") {
    fields.allow_only({"name", "type", "position", "direction", "up", "radius", "near", "far", "faces",
                       "resolution", "samples"});
    return SphereLight{fields.not_negative("radius")};
  }
  if (type == "mesh") {
    fields.allow_only({"name", "type", "file", "scale", "rotate", "translate", "direction", "up", "near",
                       "far", "faces", "resolution", "samples"});
    return MeshLight{};
  }
  fields.refuse("type", "must be rect, disk, sphere, mesh or distant");
}

/// Views of the light's map; several leave no choice of window.
void read_faces(const JsonFields& fields, Light& light) {
  light.faces = is_body(light) ? 6 : 1;
  if (fields.has("two_sided")) light.two_sided = fields.boolean("two_sided");
  const json* faces = fields.find("faces");
  if (faces == nullptr) return;
  if (is_body(light)) {
    if (*faces != 6) fields.refuse("faces", "must be 6 for sphere and mesh lights");
    return;
  }
  const std::uint32_t all = light.two_sided ? 6 : 5;
  if (*faces != 1 && *faces != all)
    fields.refuse("faces", light.two_sided ? "must be 1 or 6 for two-sided lights"
                                           : "must be 1 or 5 for rect and disk lights");
  light.faces = *faces == 1 ? 1 : all;
  for (const char* key : {"window", "fov"})
    if (light.faces > 1 && fields.has(key))
      fields.refuse(key, "must not be given together with several faces");
}

std::string read_name(const JsonFields& fields, const std::string& default_name) {
  if (!fields.has("name")) return default_name;
  std::string name = fields.text("name");
  if (name.empty() || !std::ranges::all_of(name, is_light_name_character)) {
    fields.refuse("name", "must be letters, digits, _ and - (A-Z, a-z, 0-9)");
  }
  return name;
}

std::array<double, 4> read_window(const JsonFields& fields) {
  const char* reason = "must be [x0,y0,x1,y1], four numbers with x0 < x1 and y0 < y1";
  const json& value = fields.array("window");
  if (value.size() != 4 || !std::ranges::all_of(value, is_scene_number)) fields.refuse("window", reason);
  const std::array<double, 4> w{value[0].get<double>(), value[1].get<double>(), value[2].get<double>(),
                                value[3].get<double>()};
  if (!(w[0] < w[2] && w[1] < w[3])) fields.refuse("window", reason);
  return w;
}

/// The window that `window` or `fov` gives, if one is there.
std::optional<std::array<double, 4>> read_view_window(const JsonFields& fields) {
  if (fields.has("window") && fields.has("fov"))
    fields.refuse("fov", "must not be given together with window");
  if (fields.has("window")) return read_window(fields);
  if (!fields.has("fov")) return std::nullopt;
  const double fov = fields.number("fov");
  if (!(fov > 0 && fov <= kMaxFov)) fields.refuse("fov", "must be a number > 0 and <= 120 (degrees)");
  const double t = std::tan(fov / 2 * (std::numbers::pi / 180));
  return std::array<double, 4>{-t, -t, t, t};
}

void read_depths(const JsonFields& fields, Light& light) {
  if (fields.has("near")) light.near_depth = fields.positive("near");
  if (fields.has("far")) light.far_depth = fields.positive("far");
  if (light.near_depth && light.far_depth && !(*light.near_depth < *light.far_depth)) {
    fields.refuse("near", "must be less than far");
  }
}

std::array<std::uint32_t, 2> read_resolution(const JsonFields& fields) {
  const json& value = *fields.find("resolution");
  if (!value.is_array()) {
    const std::uint32_t size = fields.count("resolution", kMaxResolution);
    return {size, size};
  }
  const bool good =
      value.size() == 2 && is_count(value[0], kMaxResolution) && is_count(value[1], kMaxResolution);
  if (!good)
    fields.refuse("resolution", fmt::format("must be R or [w,h], integers from 1 to {}", kMaxResolution));
  return {static_cast<std::uint32_t>(value[0].get<double>()),
          static_cast<std::uint32_t>(value[1].get<double>())};
}

bool is_mesh(const Light& light) {
  return std::holds_alternative<MeshLight>(light.shape);
}

/// Position and axes. A distant light is placed when the geometry is known, a mesh light by its surfaces.
void read_frame(const JsonFields& fields, Light& light) {
  if (!is_distant(light) && !is_mesh(light)) light.position = fields.vector("position");
  // The axes of what shines to all sides are those of its views alone.
  if (!is_body(light) || fields.has("direction")) light.direction = fields.vector("direction");
  if (fields.has("up")) light.up = fields.vector("up");
  switch (frame_fault(light)) {
    case FrameFault::zero_direction:
      fields.refuse("direction", "must not be zero");
    case FrameFault::parallel_up:
      fields.refuse("up", "must not be zero or parallel to direction");
    case FrameFault::none:
      break;
  }
}

/// All but the light's frame.
Light read_unplaced_light(const JsonFields& fields, const std::string& default_name,
                          const EmissionReader& read_emission) {
  Light light;
  light.shape = read_shape(fields);
  read_faces(fields, light);
  light.name = read_name(fields, default_name);
  light.window = read_view_window(fields);
  read_depths(fields, light);
  if (fields.has("resolution")) light.resolution = read_resolution(fields);
  if (fields.has("samples")) light.samples = fields.count("samples", kMaxSamples);
  if (fields.has("emission")) {
    light.emission = read_emission(fields);
    if (const char* reason = emission_fault(light)) fields.refuse("emission", reason);
  }
  return light;
}

}  // namespace

Light read_light(const json& node, const std::string& file, std::size_t index,
                 const EmissionReader& read_emission, const EmitterReader& read_emitter) {
  const JsonFields fields(node, file, join_path("lights", index));
  Light light = read_unplaced_light(fields, fmt::format("light{}", index + 1), read_emission);
  read_frame(fields, light);
  if (is_mesh(light)) set_emitter(read_emitter(fields), light);
  return light;
}

Light read_placed_light(const JsonFields& fields, const std::string& default_name, const LightPlace& place,
                        const EmissionReader& read_emission) {
  for (const char* key : {"position", "direction", "up"}) {
    if (fields.has(key)) fields.refuse(key, "is given by the node");
  }
  Light light = read_unplaced_light(fields, default_name, read_emission);
  if (is_mesh(light)) fields.refuse("type", "mesh is for lights of scene files");
  set_place(place, light);
  return light;
}

void set_place(const LightPlace& place, Light& light) {
  if (!is_distant(light)) light.position = place.position;
  light.direction = place.direction;
  light.up = place.up;
}

double read_distant_angle(const JsonFields& fields) {
  const double angle = fields.number("angle");
  if (!(angle >= 0 && angle <= kMostDistantAngle))
    fields.refuse("angle", "must be a number from 0 to 90 (degrees, the full angle)");
  return angle;
}

bool is_light_name_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace pdsm
