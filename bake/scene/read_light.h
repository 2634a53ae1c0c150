// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"
#include "scene/json_fields.h"

namespace pdsm {

/// Where a light is, and how it is turned.
struct LightPlace {
  glm::dvec3 position, direction, up;
};

/// Reads the picture that the field "emission" names. Throws Error (input).
using EmissionReader = std::function<std::shared_ptr<const EmissionImage>(const JsonFields&)>;

/// Reads the surfaces, placed, that the fields "file", "scale", "rotate" and "translate" name. Throws Error
/// (input).
using EmitterReader = std::function<std::vector<Geometry>(const JsonFields&)>;

/// One element of a scene file's "lights". A light without a name is called light1, light2, ... by its
/// place. A distant one has no position yet. Throws Error (input) "file:lights[index].field: reason".
[[nodiscard]] Light read_light(const nlohmann::json& node, const std::string& file, std::size_t index,
                               const EmissionReader& read_emission, const EmitterReader& read_emitter);

/// The same of a light object whose place is given: it has no position, direction and up of its own, and no
/// mesh. The place is not checked.
[[nodiscard]] Light read_placed_light(const JsonFields& fields, const std::string& default_name,
                                      const LightPlace& place, const EmissionReader& read_emission);

/// Puts a light there. A distant one takes the direction alone.
void set_place(const LightPlace& place, Light& light);

/// The field "angle": full angle of a distant light, degrees.
[[nodiscard]] double read_distant_angle(const JsonFields& fields);

/// Whether a light's name may have it: A-Z, a-z, 0-9, _ and -, whatever the locale.
[[nodiscard]] bool is_light_name_character(char c);

}  // namespace pdsm
