// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pdsm/bake/curves.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Of a placement's own rounding: a few operations on doubles.
constexpr double kSlack = 1e-9;

const char* fault_of(const Strands& strands) {
  const auto is_point = [](const glm::vec4& p) {
    return std::isfinite(p.x + p.y + p.z) && std::isfinite(p.w) && p.w > 0;
  };
  if (!std::ranges::all_of(strands.points, is_point)) return "must have finite points and radii above 0";
  const auto has_end = [&](std::uint32_t first) { return first + std::uint64_t{1} < strands.points.size(); };
  if (!std::ranges::all_of(strands.segments, has_end)) return "has a segment without an end";
  return nullptr;
}

/// Whether all lengths are scaled by the same factor, not 0.
bool keeps_angles(const glm::dmat4& m) {
  const double scale = length_scale(m);
  if (!(scale > 0) || !std::isfinite(scale)) return false;
  const glm::dmat3 product = glm::transpose(glm::dmat3(m)) * glm::dmat3(m);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      const double expected = column == row ? scale * scale : 0;
      if (!(std::abs(product[column][row] - expected) <= kSlack * scale * scale)) return false;
    }
    if (m[column][3] != 0 || !std::isfinite(m[3][column])) return false;
  }
  return m[3][3] == 1;
}

}  // namespace

double length_scale(const glm::dmat4& local_to_world) {
  return std::cbrt(std::abs(glm::determinant(glm::dmat3(local_to_world))));
}

void check_curves(const Curves& curves) {
  const auto refuse = [&](const char* field, const char* reason) {
    throw Error(Failure::input, curves.name + ":" + field, reason);
  };
  if (!curves.strands) refuse("strands", "is missing");
  if (const char* reason = fault_of(*curves.strands)) refuse("strands", reason);
  if (!keeps_angles(curves.local_to_world)) refuse("local_to_world", "must scale by one factor, not 0");
}

}  // namespace pdsm
