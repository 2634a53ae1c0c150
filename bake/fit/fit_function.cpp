// SPDX-License-Identifier: Apache-2.0
#include "fit/fit_function.h"

#include <algorithm>
#include <cmath>

#include "fit/least_squares.h"

namespace pdsm {
namespace {

/// The tail of the tube in which one constant serves for ever.
struct ConstantTail {
  std::int64_t begin = 0;
  std::int64_t low = 0, high = 0;  ///< of the tail's runs together
};

/// Widens the tail from the last run on while a constant passes.
ConstantTail find_constant_tail(const std::vector<TubeRun>& tube) {
  ConstantTail tail{tube.back().begin, tube.back().low, tube.back().high};
  for (std::size_t r = tube.size() - 1; r-- > 0;) {
    const std::int64_t low = std::max(tail.low, tube[r].low), high = std::min(tail.high, tube[r].high);
    if (low > high) break;
    tail = {tube[r].begin, low, high};
  }
  return tail;
}

/// A scaled value as a code of `scale` scaled values: nearest, but within [low, high] scaled.
std::uint32_t to_code(double value, std::int64_t low, std::int64_t high, std::int64_t scale) {
  const std::int64_t least = (low + scale - 1) / scale, greatest = high / scale;
  const std::int64_t code = std::llround(value / static_cast<double>(scale));
  // Between the bounds there may be no whole code: the bounds leave room for rounding to the nearest then.
  return static_cast<std::uint32_t>(least <= greatest ? std::clamp(code, least, greatest) : code);
}

/// Fits one function; holds what its pieces share.
class FunctionFit {
 public:
  FunctionFit(const StepFunction& function, const FitRules& rules, FitWorkspace& room,
              std::vector<FunctionVertex>& vertices)
      : function_(function),
        rules_(rules),
        tube_(room.tube),
        lines_(room.lines),
        vertices_(vertices),
        tail_(find_constant_tail(tube_)) {}

  void run() {
    // Nothing is needed while 0 is within the tube.
    while (run_ < tube_.size() && tube_[run_].low <= 0) ++run_;
    if (run_ == tube_.size()) return;
    std::int64_t at = tube_[run_].begin;
    while (at < tail_.begin) at = rules_.constant_pieces ? append_constant(at) : append_line(at);
    append_tail(at);
  }

 private:
  [[nodiscard]] std::int64_t run_end(std::size_t r) const { return tube_[r + 1].begin; }

  /// A constant from `at` on, as far as it goes. Returns where it ends.
  std::int64_t append_constant(std::int64_t at) {
    std::int64_t low = tube_[run_].low, high = tube_[run_].high;
    std::size_t r = run_ + 1;
    for (; r < tube_.size(); ++r) {
      const std::int64_t next_low = std::max(low, tube_[r].low), next_high = std::min(high, tube_[r].high);
      if (next_low > next_high) break;
      low = next_low;
      high = next_high;
    }
    const std::int64_t end = tube_[r].begin;
    const PieceLine line = least_squares_line(function_, rules_, at, end, segment_);
    append_vertex(at, code_of((line.begin + line.end) / 2, low, high));
    run_ = r;
    return end;
  }

  void append_vertex(std::int64_t at, std::uint32_t value) {
    vertices_.push_back({static_cast<std::uint32_t>(at), value, value});
  }

  /// A line from `at` on, as far as one goes, but not beyond the last run's begin. Returns where it ends.
  std::int64_t append_line(std::int64_t at) {
    const std::size_t first = run_;
    const std::int64_t end = reach(at);
    const PieceLine line = choose_line(at, end, first);
    vertices_.push_back({static_cast<std::uint32_t>(at), code_of(line.begin, 0, max_value()),
                         code_of(line.end, 0, max_value())});
    return end;
  }

  [[nodiscard]] std::int64_t max_value() const { return kValueScale * std::int64_t{rules_.value_codes}; }
  [[nodiscard]] std::uint32_t code_of(double value, std::int64_t low, std::int64_t high) const {
    return to_code(value, low, high, rules_.code_scale);
  }

  /// Collects windows from `at` on until no line passes the next; leaves run_ at the run that holds the
  /// end, and lines_ with a last window at the end.
  std::int64_t reach(std::int64_t at) {
    lines_.start(at, tube_[run_].low, tube_[run_].high);
    for (std::int64_t last = at;;) {
      const TubeRun &here = tube_[run_], &next = tube_[run_ + 1];
      const std::int64_t border = next.begin;
      const std::int64_t low = std::max(here.low, next.low), high = std::min(here.high, next.high);
      const bool passes_both = lines_.passes(border, low, high);
      if (!passes_both && !lines_.passes(border, here.low, here.high)) {
        const std::int64_t end = lines_.reach(last, border, here.low, here.high);
        if (end > last) lines_.add(end, here.low, here.high, {});
        return end;
      }
      ++run_;
      if (!passes_both || run_ + 1 == tube_.size()) {
        lines_.add(border, here.low, here.high, {});
        return border;
      }
      lines_.add(border, low, high, {here.low != next.low, here.high != next.high});
      last = border;
    }
  }

  /// The least-squares line over [at, end], or as near to it as the tube allows on the way from the middle
  /// of all passing lines.
  PieceLine choose_line(std::int64_t at, std::int64_t end, std::size_t first_run) {
    const auto x0 = static_cast<double>(at), x1 = static_cast<double>(end);
    const auto& s = lines_.steepest();
    const auto& f = lines_.shallowest();
    const PieceLine safe{(s.at(x0) + f.at(x0)) / 2, (s.at(x1) + f.at(x1)) / 2};
    const PieceLine best = least_squares_line(function_, rules_, at, end, segment_);
    const double share = admissible_share(at, end, first_run, safe, best);
    return {safe.begin + share * (best.begin - safe.begin), safe.end + share * (best.end - safe.end)};
  }

  /// The greatest share of the way from `safe` to `best` that stays in the tube. Both ends of every run
  /// within the piece decide.
  [[nodiscard]] double admissible_share(std::int64_t at, std::int64_t end, std::size_t first_run,
                                        const PieceLine& safe, const PieceLine& best) const {
    double share = 1;
    const double length = static_cast<double>(end - at);
    double from = safe.begin, to = best.begin;
    const auto stay_within = [&](double low, double high) {
      if (to > high) share = std::min(share, (high - from) / (to - from));
      if (to < low) share = std::min(share, (from - low) / (from - to));
    };
    for (std::size_t r = first_run; r < tube_.size() && tube_[r].begin < end; ++r) {
      const auto low = static_cast<double>(tube_[r].low), high = static_cast<double>(tube_[r].high);
      stay_within(low, high);
      const std::int64_t run_close = r + 1 < tube_.size() ? std::min(end, run_end(r)) : end;
      const double t = static_cast<double>(run_close - at) / length;
      from = safe.begin + t * (safe.end - safe.begin);
      to = best.begin + t * (best.end - best.begin);
      stay_within(low, high);
    }
    return std::max(share, 0.0);
  }

  /// The constant that holds for ever: V's last value, as near as the runs behind `at` allow.
  void append_tail(std::int64_t at) {
    std::int64_t low = tube_.back().low, high = tube_.back().high;
    for (std::size_t r = tube_.size() - 1; r > 0 && tube_[r].begin > at; --r) {
      low = std::max(low, tube_[r - 1].low);
      high = std::min(high, tube_[r - 1].high);
    }
    const double last = static_cast<double>(max_value()) * function_.count.back() / rules_.sample_count;
    const std::uint32_t value =
        code_of(std::clamp(last, static_cast<double>(low), static_cast<double>(high)), low, high);
    if (vertices_.empty() && value == 0) return;
    append_vertex(at, value);
  }

  const StepFunction& function_;
  const FitRules& rules_;
  const std::vector<TubeRun>& tube_;
  StabbingLines& lines_;
  std::vector<FunctionVertex>& vertices_;
  ConstantTail tail_;
  std::size_t run_ = 0;      ///< run of the tube that holds the current position
  std::size_t segment_ = 0;  ///< segment of V, at or before it
};

}  // namespace

void fit_function(const StepFunction& function, const FitRules& rules, FitWorkspace& room,
                  std::vector<FunctionVertex>& vertices, const std::vector<CodeBand>* bands) {
  vertices.clear();
  if (function.depth.empty()) return;
  build_tube(function, rules, room.tube_room, room.tube);
  if (bands != nullptr) relax_tube(rules, *bands, room.tube);
  FunctionFit(function, rules, room, vertices).run();
}

}  // namespace pdsm
