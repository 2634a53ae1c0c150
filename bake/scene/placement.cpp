// SPDX-License-Identifier: Apache-2.0
#include "scene/placement.h"

#include <cmath>
#include <numbers>

namespace pdsm {
namespace {

/// Cosine and sine of an angle in degrees, exact for multiples of 90.
glm::dvec2 direction_of(double degrees) {
  const double turned = std::remainder(degrees, 360.0);
  const double quarters = std::round(turned / 90);
  const double rest = (turned - quarters * 90) * (std::numbers::pi / 180);
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// A turn in the plane of axes `from` and `to`, from the one towards the other.
glm::dmat3 turn(int from, int to, double degrees) {
  const glm::dvec2 d = direction_of(degrees);
  glm::dmat3 m(1.0);
  m[from][from] = d.x;
  m[from][to] = d.y;
  m[to][from] = -d.y;
  m[to][to] = d.x;
  return m;
}

}  // namespace

glm::dmat4 placement_matrix(const glm::dvec3& scale, const glm::dvec3& rotate_degrees,
                            const glm::dvec3& translate) {
  glm::dmat3 linear =
      turn(0, 1, rotate_degrees.z) * turn(2, 0, rotate_degrees.y) * turn(1, 2, rotate_degrees.x);
  for (int axis = 0; axis < 3; ++axis) linear[axis] *= scale[axis];
  glm::dmat4 m(linear);
  m[3] = glm::dvec4(translate, 1.0);
  return m;
}

}  // namespace pdsm
