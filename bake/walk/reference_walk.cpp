// SPDX-License-Identifier: Apache-2.0
#include "walk/reference_walk.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

struct Texel {
  std::int64_t x, y;
  float begin, end;
};

/// All w in (w_end, w_begin] at which the path crosses a border of its axis, with the axis.
void collect_crossings(const RayPath& path, std::size_t axis,
                       std::vector<std::pair<double, std::size_t>>& out) {
  const double slope = path.slope[axis], fraction = path.fraction[axis];
  if (slope == 0) return;
  const double from = std::floor(fraction + slope * path.w_begin);
  const double direction = slope < 0 ? 1 : -1;
  for (double border = slope < 0 ? from + 1 : from;; border += direction) {
    const double w = std::min((border - fraction) / slope, path.w_begin);
    if (!(w > path.w_end)) return;
    out.emplace_back(w, axis);
  }
}

/// Every texel that the path crosses: sort all border crossings by depth, then replay them.
std::vector<Texel> convert_exact(const RayPath& path) {
  std::vector<std::pair<double, std::size_t>> crossings;
  collect_crossings(path, 0, crossings);
  collect_crossings(path, 1, crossings);
  std::sort(crossings.begin(), crossings.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  std::int64_t at[2];
  for (std::size_t a = 0; a < 2; ++a) {
    at[a] =
        path.base[a] + static_cast<std::int64_t>(std::floor(path.fraction[a] + path.slope[a] * path.w_begin));
  }
  std::vector<Texel> texels;
  double w = path.w_begin;
  for (const auto& [next, axis] : crossings) {
    texels.push_back({at[0], at[1], path.depth(w), path.depth(next)});
    at[axis] += path.slope[axis] < 0 ? 1 : -1;
    w = next;
  }
  texels.push_back({at[0], at[1], path.depth(w), path.depth(path.w_end)});
  return texels;
}

/// One texel a column of the major axis, in the middle of the column.
std::vector<Texel> convert_midpoint(const RayPath& path) {
  const bool x_major = std::abs(path.slope[0]) >= std::abs(path.slope[1]);
  const std::size_t major = x_major ? 0 : 1, minor = x_major ? 1 : 0;
  std::vector<std::pair<double, std::size_t>> crossings;
  collect_crossings(path, major, crossings);
  const double ratio = path.slope[major] == 0 ? 0 : path.slope[minor] / path.slope[major];
  double column = std::floor(path.fraction[major] + path.slope[major] * path.w_begin);
  std::vector<Texel> texels;
  double w = path.w_begin;
  const auto visit = [&](double next) {
    const double across = std::floor(path.fraction[minor] + (column + 0.5 - path.fraction[major]) * ratio);
    std::int64_t at[2];
    at[major] = path.base[major] + static_cast<std::int64_t>(column);
    at[minor] = path.base[minor] + static_cast<std::int64_t>(across);
    texels.push_back({at[0], at[1], path.depth(w), path.depth(next)});
  };
  for (const auto& [next, axis] : crossings) {
    visit(next);
    column += path.slope[major] < 0 ? 1 : -1;
    w = next;
  }
  visit(path.w_end);
  return texels;
}

}  // namespace

void insert_reference_events(const RayPath& path, Walk walk, const MapDepth& map, float domain_end,
                             std::multiset<ReferenceEvent>& events) {
  // The shadow set of a sample is the union of (max(m, begin), end] over the texels with m < end.
  bool in_shadow = false;
  for (const Texel& texel : walk == Walk::exact ? convert_exact(path) : convert_midpoint(path)) {
    if (!(texel.begin < texel.end) || texel.begin >= domain_end) continue;
    const float m = map(texel.x, texel.y);
    const bool shadow_here = m < std::min(texel.end, domain_end);
    const bool from_begin = shadow_here && m <= texel.begin;
    if (in_shadow && !from_begin) events.insert({texel.begin, -1});
    if (shadow_here && !(in_shadow && from_begin)) events.insert({std::max(m, texel.begin), +1});
    in_shadow = shadow_here;
  }
}

std::vector<std::pair<float, int>> accumulate_reference(const std::multiset<ReferenceEvent>& events) {
  std::vector<std::pair<float, int>> steps;
  int blocked = 0;
  for (const auto& [depth, change] : events) {
    blocked += change;
    if (steps.empty() || steps.back().first != depth)
      steps.emplace_back(depth, blocked);
    else
      steps.back().second = blocked;
  }
  return steps;
}

}  // namespace pdsm
