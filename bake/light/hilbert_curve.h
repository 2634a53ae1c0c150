// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace pdsm {

/// Puts points, at least one, finite, in the order of the Hilbert curve through their bounding cube: runs of
/// them are compact, whatever the points lie on. Those of one cell, of 65536 an axis, keep theirs. O(n log
/// n).
void sort_along_hilbert_curve(std::vector<glm::dvec3>& points);

}  // namespace pdsm
