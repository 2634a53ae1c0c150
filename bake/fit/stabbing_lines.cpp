// SPDX-License-Identifier: Apache-2.0
#include "fit/stabbing_lines.h"

#include <algorithm>

// The steepest line runs from a low end on the left to a high end on the right: among all pairs i < j the
// slope is at most (high_j - low_i) / (x_j - x_i). When a new high end lies below it, the new steepest line
// goes through that end, tangent to the upper hull of the low ends; the point of tangency only ever moves
// right. The shallowest line is its mirror image.
namespace pdsm {
namespace {

/// y of the line at x, compared with `y` without division: negative when the line is below.
std::int64_t compare(const StabbingLines::Line& line, std::int64_t x, std::int64_t y) {
  return (line.y1 - line.y0) * (x - line.x0) - (y - line.y0) * (line.x1 - line.x0);
}

}  // namespace

void StabbingLines::start(std::int64_t x, std::int64_t low, std::int64_t high) {
  windows_ = 1;
  lows_.points.assign(1, {x, low});
  highs_.points.assign(1, {x, high});
  lows_.pivot = highs_.pivot = 0;
}

bool StabbingLines::passes(std::int64_t x, std::int64_t low, std::int64_t high) const {
  if (low > high) return false;
  return windows_ == 1 || (compare(steepest_, x, low) >= 0 && compare(shallowest_, x, high) <= 0);
}

void StabbingLines::extend_lower(const Point& p) {
  auto& points = lows_.points;
  while (points.size() >= lows_.pivot + 2 && !is_left_turn(p, points.back(), points[points.size() - 2]))
    points.pop_back();
  points.push_back(p);
}

void StabbingLines::extend_upper(const Point& p) {
  auto& points = highs_.points;
  while (points.size() >= highs_.pivot + 2 && is_left_turn(p, points.back(), points[points.size() - 2]))
    points.pop_back();
  points.push_back(p);
}

void StabbingLines::add(std::int64_t x, std::int64_t low, std::int64_t high) {
  if (windows_ == 1 || compare(steepest_, x, high) > 0) {
    // Tangent from the new high end to the upper hull of the low ends: the least slope.
    auto& [points, pivot] = lows_;
    while (pivot + 1 < points.size() && is_left_turn({x, high}, points[pivot + 1], points[pivot])) ++pivot;
    steepest_ = {points[pivot].x, points[pivot].y, x, high};
  }
  if (windows_ == 1 || compare(shallowest_, x, low) < 0) {
    auto& [points, pivot] = highs_;
    while (pivot + 1 < points.size() && is_left_turn({x, low}, points[pivot], points[pivot + 1])) ++pivot;
    shallowest_ = {points[pivot].x, points[pivot].y, x, low};
  }
  extend_lower({x, low});
  extend_upper({x, high});
  ++windows_;
}

std::int64_t StabbingLines::reach(std::int64_t x, std::int64_t limit, std::int64_t low,
                                  std::int64_t high) const {
  const std::int64_t fall = steepest_.y0 - steepest_.y1, rise = shallowest_.y1 - shallowest_.y0;
  // A falling steepest line meets `low`, a rising shallowest line `high`; at most one of them is in the way.
  if (fall > 0)
    limit = std::min(limit, steepest_.x0 + (steepest_.y0 - low) * (steepest_.x1 - steepest_.x0) / fall);
  if (rise > 0)
    limit =
        std::min(limit, shallowest_.x0 + (high - shallowest_.y0) * (shallowest_.x1 - shallowest_.x0) / rise);
  return std::max(limit, x);
}

}  // namespace pdsm
