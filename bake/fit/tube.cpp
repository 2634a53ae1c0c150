// SPDX-License-Identifier: Apache-2.0
#include "fit/tube.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// Segment k of V is constant on (x_k, x_k+1]. A window of half width delta around a depth meets it if the
/// depth is in [x_k - delta, x_k+1 + delta]: whole codes within that are [opens[k], closes[k]]. Both grow
/// with k, and since 2 delta holds a code, segment k + 1 opens before k closes.
void find_reach(const StepFunction& function, const FitRules& rules, TubeWorkspace& room) {
  const std::size_t steps = function.depth.size();
  room.opens.resize(steps + 2);
  room.closes.resize(steps + 1);
  room.opens[0] = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double at = rules.code_of(function.depth[k]);
    room.opens[k + 1] = round_up(std::max(at - rules.tolerance_codes, 0.0));
    room.closes[k] = static_cast<std::int64_t>(std::max(at + rules.tolerance_codes, 0.0));
  }
  room.closes[steps] = room.opens[steps + 1] = kNever;
}

CountRange join(const CountRange& a, const CountRange& b) {
  return {std::min(a.least, b.least), std::max(a.greatest, b.greatest)};
}

/// Counts of a sliding range of segments, a queue of two stacks: ranges from each of its older segments to
/// the last of these are at hand, the newer ones are summed up in one. Hardly a branch that a processor can't
/// foresee.
class SlidingRange {
 public:
  SlidingRange(CountRange* older, const std::uint32_t* counts) : older_(older), count_(counts) {
    older_[0] = range_of(0);
  }
  /// Moves the range's begin, and its end to `end`.
  void drop_before(std::uint32_t first, std::uint32_t end) {
    if (first < newer_from_) return;
    CountRange range;
    for (std::uint32_t segment = end; segment-- > first;)
      older_[segment] = range = join(range, range_of(segment));
    newer_from_ = end;
    newer_ = {};
  }
  /// Takes in a segment, of at least 1, or nothing if it does not `come` yet.
  void push(std::uint32_t segment, bool comes) {
    const std::uint32_t count = count_[segment - 1];
    newer_.least = comes ? std::min(newer_.least, count) : newer_.least;
    newer_.greatest = comes ? std::max(newer_.greatest, count) : newer_.greatest;
  }
  [[nodiscard]] CountRange from(std::uint32_t first) const { return join(older_[first], newer_); }

 private:
  [[nodiscard]] CountRange range_of(std::uint32_t segment) const {
    const std::uint32_t count = segment == 0 ? 0 : count_[segment - 1];
    return {count, count};
  }

  CountRange* older_;
  const std::uint32_t* count_;
  CountRange newer_;
  std::uint32_t newer_from_ = 1;
};

/// Opens and closes one segment at a time; what happens at the same code makes one run. `bounds_of` gives a
/// range's CountBounds. Writes at most one run for each opening and closing, and returns where it ended;
/// `runs` has room for one more. Each step writes a run, and keeps it or not: nobody can foresee which.
template <typename BoundsOf>
std::size_t slide(const TubeWorkspace& room, SlidingRange counts, std::int64_t last_code,
                  const BoundsOf& bounds_of, TubeRun* runs, std::int64_t& at) {
  const std::int64_t *const opens = room.opens.data(), *const closes = room.closes.data();
  const auto last_segment = static_cast<std::uint32_t>(room.closes.size() - 1);
  std::uint32_t first = 0, next = 1;  // segments [first, next) are within delta
  std::size_t size = 0;
  CountBounds last{-1, -1};
  at = 0;
  while (at <= last_code) {
    first += closes[first] <= at ? 1 : 0;
    const bool comes = opens[next] <= at;
    counts.push(std::min(next, last_segment), comes);
    next += comes ? 1 : 0;
    counts.drop_before(first, next);
    const std::int64_t after = std::min(closes[first], opens[next]);
    const CountBounds bounds = bounds_of(counts.from(first));
    runs[size] = {at, bounds.lower, bounds.upper};
    const bool is_new = (after > at) & ((bounds.lower != last.lower) | (bounds.upper != last.upper));
    size += is_new;
    last = is_new ? bounds : last;
    at = after;
  }
  return size;
}

}  // namespace

void build_tube(const StepFunction& function, const FitRules& rules, TubeWorkspace& room,
                std::vector<TubeRun>& tube) {
  find_reach(function, rules, room);
  room.older.resize(function.count.size() + 1);
  tube.resize(2 * function.count.size() + 3);
  const SlidingRange counts(room.older.data(), function.count.data());
  std::int64_t at = 0;
  std::size_t size = 0;
  if (rules.lower.empty()) {
    const auto bounds_of = [&rules](const CountRange& range) -> CountBounds {
      return {rules.bounds_of(range.least).lower, rules.bounds_of(range.greatest).upper};
    };
    size = slide(room, counts, rules.coding.depth_max(), bounds_of, tube.data(), at);
  } else {
    const auto bounds_of = [lower = rules.lower.data(),
                            upper = rules.upper.data()](const CountRange& range) -> CountBounds {
      return {lower[range.least], upper[range.greatest]};
    };
    size = slide(room, counts, rules.coding.depth_max(), bounds_of, tube.data(), at);
  }
  tube.resize(size);
  // What holds beyond the last code is V's last value, which the last run has room for.
  const std::uint32_t last_count = function.count.back();
  if (at != kNever) tube.back() = {tube.back().begin, rules.lower_of(last_count), rules.upper_of(last_count)};
}

void relax_tube(const FitRules& rules, std::span<const CodeBand> bands, std::vector<TubeRun>& tube) {
  const std::int64_t free_high = kValueScale * std::int64_t{rules.value_codes};
  std::vector<TubeRun> relaxed;
  const auto append = [&relaxed](const TubeRun& run) {
    if (!relaxed.empty() && relaxed.back().begin == run.begin) relaxed.pop_back();
    const bool goes_on = !relaxed.empty() && relaxed.back().low == run.low && relaxed.back().high == run.high;
    if (!goes_on) relaxed.push_back(run);
  };
  const auto runs_from = [&tube](std::int64_t code) {
    return std::prev(std::upper_bound(tube.begin(), tube.end(), code,
                                      [](std::int64_t x, const TubeRun& run) { return x < run.begin; }));
  };
  append({0, 0, free_high});
  for (const CodeBand& band : bands) {
    for (auto run = runs_from(band.first); run != tube.end() && run->begin < band.last; ++run) {
      append({std::max(run->begin, band.first), run->low, run->high});
    }
    append({band.last, 0, free_high});
  }
  tube = std::move(relaxed);
}

}  // namespace pdsm
