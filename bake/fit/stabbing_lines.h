// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace pdsm {

/// The set of all lines that pass through a growing sequence of vertical windows [low, high] at increasing
/// positions: its two extreme lines, kept exactly in integers, amortised O(1) a window.
/// Positions below 2^32, values below 2^25.
/// Paper: O'Rourke, "An on-line algorithm for fitting straight lines between data ranges", 1981.
class StabbingLines {
 public:
  struct Line {
    std::int64_t x0 = 0, y0 = 0, x1 = 1, y1 = 0;  ///< through (x0, y0) and (x1, y1), x0 < x1

    [[nodiscard]] double at(double x) const {
      return static_cast<double>(y0) +
             (x - static_cast<double>(x0)) * static_cast<double>(y1 - y0) / static_cast<double>(x1 - x0);
    }
  };

  /// Starts anew with one window.
  void start(std::int64_t x, std::int64_t low, std::int64_t high);

  /// Whether some line also passes the window at x, right of all others.
  [[nodiscard]] bool passes(std::int64_t x, std::int64_t low, std::int64_t high) const;

  /// Adds a window that passes().
  void add(std::int64_t x, std::int64_t low, std::int64_t high);

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
  void extend_lower(const Point& p);
  void extend_upper(const Point& p);

  std::size_t windows_ = 0;
  Chain lows_, highs_;  ///< upper hull of the low ends, lower hull of the high ends
  Line steepest_, shallowest_;
};

}  // namespace pdsm
