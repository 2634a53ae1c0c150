// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace pdsm {

/// M = T Rz Ry Rx S about fixed axes: first scaled, then turned about x, y and z (degrees, counter-clockwise
/// seen from the axis' end), then moved. Quarter turns are exact.
[[nodiscard]] glm::dmat4 placement_matrix(const glm::dvec3& scale, const glm::dvec3& rotate_degrees,
                                          const glm::dvec3& translate);

}  // namespace pdsm
