// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pdsm/bake/scene.h"

namespace pdsm::test {

/// A closed box about the origin, fronts outwards.
Mesh box_mesh(const glm::dvec3& size);

/// An open rectangle in the plane y = 0 about the origin, facing up.
Mesh plate_mesh(double size_x, double size_z);

/// The mesh as an OBJ file.
std::string to_obj(const Mesh& mesh);

/// `mesh` in a scene, moved by `translate` in double.
Geometry placed(const Mesh& mesh, const glm::dvec3& translate);
Geometry placed(const Mesh& mesh, const glm::dmat4& local_to_world);

/// Volume that closed geometry encloses in the world; negative when its fronts look inwards.
double signed_volume(const Geometry& geometry);

/// A rect light that looks down from `position`, its width along world x and its height along world z.
Light lamp_above(const glm::dvec3& position, double width, double height);

}  // namespace pdsm::test
