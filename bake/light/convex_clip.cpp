// SPDX-License-Identifier: Apache-2.0
#include "light/convex_clip.h"

#include <cassert>

namespace pdsm {
namespace {

/// The part of `polygon` in one half-space.
SmallPolygon clip_once(const SmallPolygon& polygon, const HalfSpace& half_space) {
  SmallPolygon kept;
  const auto corners = polygon.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double da = half_space.distance(a), db = half_space.distance(b);
    if (da >= 0) kept.push(a);
    // The cut is computed from the inner corner on, so that both triangles of an edge get the same point.
    if (da > 0 && db < 0) kept.push(a + (b - a) * (da / (da - db)));
    if (da < 0 && db > 0) kept.push(b + (a - b) * (db / (db - da)));
  }
  return kept;
}

}  // namespace

void ConvexRegion::add(const HalfSpace& half_space) {
  assert(count_ < kMaxHalfSpaces);
  half_spaces_[count_++] = half_space;
}

void SmallPolygon::push(const glm::dvec3& corner) {
  // Rounding can make a sliver look concave; the corner that is then too many is dropped.
  if (count_ < corners_.size()) corners_[count_++] = corner;
}

SmallPolygon clip(const SmallPolygon& polygon, const ConvexRegion& region, std::uint32_t crossed) {
  SmallPolygon kept = polygon;
  const auto half_spaces = region.half_spaces();
  for (std::size_t i = 0; i < half_spaces.size() && !kept.corners().empty(); ++i) {
    if ((crossed >> i) & 1U) kept = clip_once(kept, half_spaces[i]);
  }
  return kept;
}

double area(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return glm::length(sum) / 2;
}

}  // namespace pdsm
