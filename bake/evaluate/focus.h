// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What a picture is about: a sphere, world, metres.
struct Focus {
  glm::dvec3 centre{0};
  double radius = 1;
};

/// Geometry, and the surfaces around volumes and curves.
[[nodiscard]] std::vector<Geometry> all_surfaces(const Scene& scene);

/// A sphere around the casters, without ground and walls that dwarf them; around everything when nothing
/// casts. `all`: all_surfaces().
[[nodiscard]] Focus focus_on_casters(std::span<const Geometry> all);

}  // namespace pdsm
