// SPDX-License-Identifier: Apache-2.0
#include "walk/walk_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// One axis of a path while it is walked towards smaller w: the texel, and the w at which it is left.
struct AxisCursor {
  double fraction, slope, w_begin;
  std::int32_t texel;
  double leave_w;

  AxisCursor(const RayPath& path, std::size_t axis)
      : fraction(path.fraction[axis]),
        slope(path.slope[axis]),
        w_begin(path.w_begin),
        texel(static_cast<std::int32_t>(std::floor(fraction + slope * path.w_begin))) {
    find_leave();
  }

  /// w shrinks along the ray, so that g grows where the slope is negative.
  void find_leave() {
    if (slope == 0) {
      leave_w = -std::numeric_limits<double>::infinity();
      return;
    }
    const double border = slope < 0 ? texel + 1.0 : static_cast<double>(texel);
    leave_w = std::min((border - fraction) / slope, w_begin);
  }

  void step() {
    texel += slope < 0 ? 1 : -1;
    find_leave();
  }
};

/// Appends a step that ends at `end`, unless nothing of it is left in float.
void append(std::vector<WalkStep>& steps, std::int32_t dx, std::int32_t dy, float& depth, float end) {
  if (!(end > depth)) return;
  steps.push_back({dx, dy, depth, end});
  depth = end;
}

void list_exact(const RayPath& path, std::vector<WalkStep>& steps) {
  AxisCursor x(path, 0), y(path, 1);
  float depth = path.depth(path.w_begin);
  while (std::max(x.leave_w, y.leave_w) > path.w_end) {
    const double w = std::max(x.leave_w, y.leave_w);
    append(steps, x.texel, y.texel, depth, path.depth(w));
    const bool step_x = x.leave_w == w, step_y = y.leave_w == w;
    if (step_x) x.step();
    if (step_y) y.step();
  }
  append(steps, x.texel, y.texel, depth, path.depth(path.w_end));
}

void list_midpoint(const RayPath& path, std::vector<WalkStep>& steps) {
  const std::size_t major = std::abs(path.slope[0]) >= std::abs(path.slope[1]) ? 0 : 1, minor = 1 - major;
  const double minor_per_major = path.slope[major] == 0 ? 0 : path.slope[minor] / path.slope[major];
  AxisCursor cursor(path, major);
  float depth = path.depth(path.w_begin);
  const auto visit = [&](float end) {
    const double run = cursor.texel + 0.5 - path.fraction[major];
    const auto across = static_cast<std::int32_t>(std::floor(path.fraction[minor] + run * minor_per_major));
    append(steps, major == 0 ? cursor.texel : across, major == 0 ? across : cursor.texel, depth, end);
  };
  while (cursor.leave_w > path.w_end) {
    visit(path.depth(cursor.leave_w));
    cursor.step();
  }
  visit(path.depth(path.w_end));
}

}  // namespace

void list_walk_steps(const RayPath& path, Walk walk, std::vector<WalkStep>& steps) {
  steps.clear();
  if (walk == Walk::exact)
    list_exact(path, steps);
  else
    list_midpoint(path, steps);
}

}  // namespace pdsm
