// SPDX-License-Identifier: Apache-2.0
#include "scene/read_placement.h"

#include <cmath>

#include "scene/placement.h"

namespace pdsm {
namespace {

using nlohmann::json;

/// The scale of a placement: a number or one an axis, none of them 0.
glm::dvec3 read_scale(const JsonFields& fields) {
  const json* value = fields.find("scale");
  if (value == nullptr) return glm::dvec3(1);
  if (!value->is_number() && !value->is_array()) fields.refuse("scale", "must be a number or [x,y,z], not 0");
  const glm::dvec3 scale = value->is_number() ? glm::dvec3(fields.number("scale")) : fields.vector("scale");
  // Anything smaller is flat in float.
  constexpr double kMinScale = 1e-12;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(scale[axis]) >= kMinScale)) fields.refuse("scale", "must be a number or [x,y,z], not 0");
  }
  return scale;
}

}  // namespace

glm::dmat4 read_placement(const JsonFields& fields) {
  const auto vector_or_zero = [&](const char* key) {
    return fields.has(key) ? fields.vector(key) : glm::dvec3(0);
  };
  return placement_matrix(read_scale(fields), vector_or_zero("rotate"), vector_or_zero("translate"));
}

}  // namespace pdsm
