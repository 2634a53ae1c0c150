// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "light/point_sets.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// Samples of a mesh light, light space: points that stand for what is seen of it from any side
/// (docs/maths.md, "Mesh lights"). Candidates lie on chords of the mesh where it is closed, else on its
/// surface, and are cut into strata of equal numbers along a Hilbert curve; each gives one sample. `mesh` has
/// an area (check_mesh_light()). O(candidates x log triangles); throws Error (resource) when Embree fails.
[[nodiscard]] std::vector<std::array<double, 3>> mesh_samples(const Mesh& mesh, const SampleSet& set);

}  // namespace pdsm
