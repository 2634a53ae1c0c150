// SPDX-License-Identifier: Apache-2.0
// The fit uses the fewest pieces: against a dynamic programme over all ways to cut a short depth range,
// whose lines are found by trying all candidates, in exact integers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fit/fit_function.h"
#include "fit/stabbing_lines.h"
#include "support/step_functions.h"

namespace pdsm::test {
namespace {

struct Window {
  std::int64_t x, low, high;
};

/// Whether the line through (x0, y0) and (x1, y1) passes all windows.
bool line_passes(const std::vector<Window>& windows, std::int64_t x0, std::int64_t y0, std::int64_t x1,
                 std::int64_t y1) {
  const std::int64_t run = x1 - x0;
  return std::all_of(windows.begin(), windows.end(), [&](const Window& w) {
    const std::int64_t y = y0 * run + (y1 - y0) * (w.x - x0);
    return w.low * run <= y && y <= w.high * run;
  });
}

/// If any line passes bounded windows at two or more positions, then one through two of their ends does.
bool some_line_passes(const std::vector<Window>& windows) {
  for (const Window& w : windows) {
    if (w.low > w.high) return false;
  }
  if (windows.size() < 2) return true;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    for (std::size_t j = i + 1; j < windows.size(); ++j) {
      for (const std::int64_t a : {windows[i].low, windows[i].high}) {
        for (const std::int64_t b : {windows[j].low, windows[j].high}) {
          if (line_passes(windows, windows[i].x, a, windows[j].x, b)) return true;
        }
      }
    }
  }
  return false;
}

/// The tube between neighbouring whole codes in [first, last], by its definition: V's segments that are
/// within delta of every depth between the two codes.
class ShortTube {
 public:
  ShortTube(const StepFunction& function, const FitRules& rules, std::int64_t first, std::int64_t last)
      : rules_(rules), first_(first), last_(last) {
    for (std::int64_t c = first; c < last; ++c) between_.push_back(bounds_within(function, c));
    const std::uint32_t end = function.count.back();
    forever_ = {last, rules.lower[end], rules.upper[end]};
  }

  /// The fewest vertices: none if 0 serves for ever, else by the number of vertices up to each code.
  [[nodiscard]] int fewest_vertices() const {
    constexpr int kNever = std::numeric_limits<int>::max() / 2;
    if (holds_zero_until(last_) && forever_.low <= 0) return 0;
    std::vector<int> vertices(static_cast<std::size_t>(last_ - first_ + 1), kNever);
    int fewest = kNever;
    for (std::int64_t at = first_; at <= last_; ++at) {
      int& here = vertices[static_cast<std::size_t>(at - first_)];
      if (holds_zero_until(at)) here = 1;
      if (here == kNever) continue;
      if (constant_serves(at, last_, true)) fewest = std::min(fewest, here);
      for (std::int64_t to = at + 1; to <= last_ && piece_serves(at, to); ++to) {
        int& there = vertices[static_cast<std::size_t>(to - first_)];
        there = std::min(there, here + 1);
      }
    }
    return fewest;
  }

 private:
  [[nodiscard]] Window bounds_within(const StepFunction& function, std::int64_t c) const {
    std::uint32_t least = std::numeric_limits<std::uint32_t>::max(), greatest = 0;
    for (std::size_t k = 0; k <= function.depth.size(); ++k) {
      const double reach = rules_.tolerance_codes;
      const bool from =
          k == 0 || static_cast<double>(function.depth[k - 1]) - reach <= static_cast<double>(c);
      const bool to = k == function.depth.size() ||
                      static_cast<double>(function.depth[k]) + reach >= static_cast<double>(c + 1);
      if (!from || !to) continue;
      const std::uint32_t count = k == 0 ? 0 : function.count[k - 1];
      least = std::min(least, count);
      greatest = std::max(greatest, count);
    }
    return {c, rules_.lower[least], rules_.upper[greatest]};
  }

  [[nodiscard]] const Window& between(std::int64_t c) const {
    return between_[static_cast<std::size_t>(c - first_)];
  }

  [[nodiscard]] bool holds_zero_until(std::int64_t at) const {
    for (std::int64_t c = first_; c < at; ++c) {
      if (between(c).low > 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool constant_serves(std::int64_t from, std::int64_t to, bool for_ever) const {
    std::int64_t low = for_ever ? forever_.low : 0,
                 high = for_ever ? forever_.high : std::numeric_limits<std::int64_t>::max();
    for (std::int64_t c = from; c < to; ++c) {
      low = std::max(low, between(c).low);
      high = std::min(high, between(c).high);
    }
    return low <= high;
  }

  [[nodiscard]] bool piece_serves(std::int64_t from, std::int64_t to) const {
    if (rules_.constant_pieces) return constant_serves(from, to, false);
    std::vector<Window> windows{{from, between(from).low, between(from).high}};
    for (std::int64_t c = from + 1; c < to; ++c) {
      const Window &left = between(c - 1), &right = between(c);
      if (left.low != right.low || left.high != right.high) {
        windows.push_back({c, std::max(left.low, right.low), std::min(left.high, right.high)});
      }
    }
    windows.push_back({to, between(to - 1).low, between(to - 1).high});
    return some_line_passes(windows);
  }

  const FitRules& rules_;
  std::int64_t first_, last_;
  std::vector<Window> between_;
  Window forever_{};
};

/// Rules whose depth codes are the depths themselves.
FitRules code_rules(std::uint32_t samples, double epsilon, double tolerance_codes) {
  FitRules rules = make_fit_rules(depth_view(1, 2), samples, epsilon, 0.1);
  rules.near_depth = 0;
  rules.codes_per_metre = 1;
  rules.tolerance = rules.tolerance_codes = tolerance_codes;
  return rules;
}

StepFunction short_function(Random& random, std::uint32_t samples, double first, double last) {
  std::set<float> depths;
  const std::int64_t steps = random.integer(1, 9);
  for (std::int64_t n = 0; n < steps; ++n) {
    // Quarters of codes, so that ties with whole codes come up.
    depths.insert(static_cast<float>(std::min(last, std::round(4 * random.uniform(first, last)) / 4)));
  }
  StepFunction function;
  std::uint32_t before = 0;
  for (const float depth : depths) {
    const std::uint32_t count = random.count(0, samples);
    if (count == before) continue;
    function.depth.push_back(depth);
    function.count.push_back(count);
    before = count;
  }
  return function;
}

void expect_fewest(std::uint64_t seed, int cases, double first, double last, std::int64_t first_code,
                   std::int64_t last_code) {
  Random random(seed);
  FitWorkspace room;
  std::vector<FunctionVertex> vertices;
  int fitted = 0;
  for (int n = 0; n < cases; ++n) {
    const std::uint32_t samples = random.pick({2u, 7u, 256u});
    const double epsilon = random.pick({0.0, 0.01, 0.05, 0.1, 0.3});
    const FitRules rules = code_rules(samples, epsilon, random.pick({0.5, 0.75, 1.0, 2.3, 4.0}));
    const StepFunction function = short_function(random, samples, first, last);
    if (function.depth.empty()) continue;
    fit_function(function, rules, room, vertices);
    const ShortTube tube(function, rules, first_code, last_code);
    ASSERT_EQ(static_cast<int>(vertices.size()), tube.fewest_vertices())
        << "case " << n << ", epsilon " << epsilon << ", delta " << rules.tolerance_codes;
    ++fitted;
  }
  EXPECT_GT(fitted, cases / 2);
}

// Behind the last event + delta nothing changes: codes 0 .. 40 hold all that matters.
TEST(FitPieces, AreFewestAtTheBeginningOfTheRange) {
  expect_fewest(21, 400, 0, 34, 0, 40);
}

// Events up to the last code, whose delta reaches behind it.
TEST(FitPieces, AreFewestAtTheEndOfTheRange) {
  expect_fewest(22, 400, 65505, 65535, 65495, 65535);
}

TEST(StabbingLines, AcceptWindowsAsLongAsALinePasses) {
  Random random(23);
  StabbingLines lines;
  for (int n = 0; n < 2000; ++n) {
    std::vector<Window> windows;
    std::int64_t x = random.integer(0, 5);
    const std::int64_t spread = random.pick({4, 30, 1000}), width = random.pick({0, 3, 100});
    while (windows.size() < 40) {
      const std::int64_t low = random.integer(0, spread) + 2 * static_cast<std::int64_t>(windows.size());
      const Window w{x, low, low + random.integer(0, width) + spread / 2};
      if (windows.empty()) {
        lines.start(w.x, w.low, w.high);
        windows.push_back(w);
      } else {
        windows.push_back(w);
        const bool expected = some_line_passes(windows);
        ASSERT_EQ(lines.passes(w.x, w.low, w.high), expected) << "case " << n;
        if (!expected) break;
        lines.add(w.x, w.low, w.high);
        // The extreme lines pass everything and bound all that do.
        const auto &steep = lines.steepest(), &flat = lines.shallowest();
        ASSERT_TRUE(line_passes(windows, steep.x0, steep.y0, steep.x1, steep.y1)) << "case " << n;
        ASSERT_TRUE(line_passes(windows, flat.x0, flat.y0, flat.x1, flat.y1)) << "case " << n;
      }
      x += random.integer(1, 9);
    }
  }
}

TEST(StabbingLines, ReachIsTheLastPositionWithALine) {
  Random random(24);
  StabbingLines lines;
  int cut = 0;
  for (int n = 0; n < 3000; ++n) {
    std::int64_t x = 0;
    const auto draw = [&] {
      const std::int64_t low = random.integer(0, 20);
      return Window{x, low, low + random.integer(0, 20)};
    };
    std::vector<Window> windows{draw()};
    lines.start(windows[0].x, windows[0].low, windows[0].high);
    const std::int64_t wanted = random.integer(2, 5);
    while (static_cast<std::int64_t>(windows.size()) < wanted) {
      x += random.integer(1, 6);
      const Window w = draw();
      if (!lines.passes(w.x, w.low, w.high)) break;
      lines.add(w.x, w.low, w.high);
      windows.push_back(w);
    }
    if (windows.size() < 2) continue;
    // The window of the last position goes on, as a run of the tube does.
    const Window last = windows.back();
    const std::int64_t limit = last.x + random.integer(0, 40);
    std::int64_t expected = last.x;
    while (expected < limit) {
      std::vector<Window> more = windows;
      more.push_back({expected + 1, last.low, last.high});
      if (!some_line_passes(more)) break;
      ++expected;
    }
    ASSERT_EQ(lines.reach(last.x, limit, last.low, last.high), expected) << "case " << n;
    cut += expected < limit ? 1 : 0;
  }
  EXPECT_GT(cut, 100);
}

/// The largest numbers that a fit gives it: positions of 32 bits, values of 2^24 + 8 bits of scale.
TEST(StabbingLines, HoldTheLargestCodesWithoutOverflow) {
  constexpr std::int64_t kLast = 0xFFFFFFFF, kMost = 256 * 65535;
  StabbingLines lines;
  lines.start(0, 0, 1);
  lines.add(kLast - 2, kMost - 1, kMost);
  EXPECT_TRUE(lines.passes(kLast, kMost - 1, kMost));
  EXPECT_FALSE(lines.passes(kLast, 0, kMost - 2));
  lines.start(0, kMost - 1, kMost);
  lines.add(kLast - 1, 0, 1);
  EXPECT_TRUE(lines.passes(kLast, 0, 0));
  EXPECT_FALSE(lines.passes(kLast, 3, kMost));
}

}  // namespace
}  // namespace pdsm::test
