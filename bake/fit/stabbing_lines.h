// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace pdsm {

/// The set of all lines that pass through a growing sequence of vertical windows [low, high] at increasing
/// positions: its two extreme lines, kept exactly in integers, amortised O(1) a window. Inline, for fits
/// spend most of their time here. Positions below 2^32, values below 2^25. Paper: O'Rourke, "An on-line
/// algorithm for fitting straight lines between data ranges", 1981.
class StabbingLines {
 public:
  struct Line {
    std::int64_t x0 = 0, y0 = 0, x1 = 1, y1 = 0;  ///< through (x0, y0) and (x1, y1), x0 < x1

    [[nodiscard]] double at(double x) const {
      return static_cast<double>(y0) +
             (x - static_cast<double>(x0)) * static_cast<double>(y1 - y0) / static_cast<double>(x1 - x0);
    }
  };

  struct Ends {
    bool low = false, high = false;
  };

  /// Starts anew with one window.
  void start(std::int64_t x, std::int64_t low, std::int64_t high) {
    windows_ = 1;
    lows_.points.assign(1, {x, low});
    highs_.points.assign(1, {x, high});
    lows_.pivot = highs_.pivot = 0;
  }

  /// Whether some line also passes the window at x, right of all others.
  [[nodiscard]] bool passes(std::int64_t x, std::int64_t low, std::int64_t high) const {
    if (low > high) return false;
    return windows_ == 1 || (compare(steepest_, x, low) >= 0 && compare(shallowest_, x, high) <= 0);
  }

  /// Adds a window that passes(). The steepest line runs from a low end on the left to a high end on the
  /// right: among all pairs i < j the slope is at most (high_j - low_i) / (x_j - x_i). When a new high end
  /// lies below it, the new steepest line goes through that end, tangent to the upper hull of the low ends;
  /// the point of tangency only ever moves right. The shallowest line is its mirror image.
  /// `turns`: the ends that matter to windows added later. An end that lies between two of its side of the
  /// same height, or tighter, does not: lines that pass both pass it, and tangents from behind touch the
  /// former.
  [[gnu::always_inline]] void add(std::int64_t x, std::int64_t low, std::int64_t high,
                                  Ends turns = {true, true}) {
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
    if (turns.low) extend_lower({x, low});
    if (turns.high) extend_upper({x, high});
    ++windows_;
  }

  /// The greatest position in [x, limit] at which some line still passes a window [low, high], which it
  /// does at x, the last window's position. Needs two windows.
  [[nodiscard]] std::int64_t reach(std::int64_t x, std::int64_t limit, std::int64_t low,
                                   std::int64_t high) const;

  /// The lines of greatest and least slope; they cross. Need two windows.
  [[nodiscard]] const Line& steepest() const { return steepest_; }
  [[nodiscard]] const Line& shallowest() const { return shallowest_; }

 private:
  struct Point {
    std::int64_t x, y;
  };

  /// A convex chain of window ends on one side, with the vertex that the extreme line turns about.
  struct Chain {
    std::vector<Point> points;
    std::size_t pivot = 0;
  };

  static bool is_left_turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  }
  /// y of the line at x, compared with `y` without division: negative when the line is below.
  static std::int64_t compare(const Line& line, std::int64_t x, std::int64_t y) {
    return (line.y1 - line.y0) * (x - line.x0) - (y - line.y0) * (line.x1 - line.x0);
  }
  void extend_lower(const Point& p) {
    auto& points = lows_.points;
    while (points.size() >= lows_.pivot + 2 && !is_left_turn(p, points.back(), points[points.size() - 2]))
      points.pop_back();
    points.push_back(p);
  }
  void extend_upper(const Point& p) {
    auto& points = highs_.points;
    while (points.size() >= highs_.pivot + 2 && is_left_turn(p, points.back(), points[points.size() - 2]))
      points.pop_back();
    points.push_back(p);
  }

  std::size_t windows_ = 0;
  Chain lows_, highs_;  ///< upper hull of the low ends, lower hull of the high ends
  Line steepest_, shallowest_;
};

}  // namespace pdsm
