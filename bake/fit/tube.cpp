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
  room.opens.resize(steps + 1);
  room.closes.resize(steps + 1);
  room.opens[0] = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double at = rules.code_of(function.depth[k]);
    room.opens[k + 1] = round_up(std::max(at - rules.tolerance_codes, 0.0));
    room.closes[k] = static_cast<std::int64_t>(std::max(at + rules.tolerance_codes, 0.0));
  }
  room.closes[steps] = kNever;
}

/// Minimum (or maximum, by `Before`) of the counts of a sliding range of segments: a monotone queue.
template <typename Before>
class SlidingExtreme {
 public:
  SlidingExtreme(std::vector<std::uint32_t>& queue, const StepFunction& function)
      : queue_(queue), function_(function) {
    queue_.clear();
  }
  void push(std::uint32_t segment) {
    while (queue_.size() > head_ && !Before()(count(queue_.back()), count(segment))) queue_.pop_back();
    queue_.push_back(segment);
  }
  void drop_before(std::uint32_t segment) {
    while (queue_[head_] < segment) ++head_;
  }
  [[nodiscard]] std::uint32_t get() const { return count(queue_[head_]); }

 private:
  [[nodiscard]] std::uint32_t count(std::uint32_t segment) const {
    return segment == 0 ? 0 : function_.count[segment - 1];
  }
  std::vector<std::uint32_t>& queue_;
  const StepFunction& function_;
  std::size_t head_ = 0;
};

}  // namespace

void build_tube(const StepFunction& function, const FitRules& rules, TubeWorkspace& room,
                std::vector<TubeRun>& tube) {
  find_reach(function, rules, room);
  tube.clear();
  const auto segments = static_cast<std::uint32_t>(room.opens.size());
  SlidingExtreme<std::less<>> least(room.least, function);
  SlidingExtreme<std::greater<>> greatest(room.greatest, function);
  std::uint32_t first = 0, next = 0;  // segments [first, next) are within delta
  std::int64_t at = 0;
  const std::int64_t last_code = rules.coding.depth_max();
  while (at <= last_code) {
    while (next < segments && room.opens[next] <= at) {
      least.push(next);
      greatest.push(next);
      ++next;
    }
    while (room.closes[first] <= at) ++first;
    least.drop_before(first);
    greatest.drop_before(first);
    const std::int64_t low = rules.lower_of(least.get()), high = rules.upper_of(greatest.get());
    if (tube.empty() || tube.back().low != low || tube.back().high != high) tube.push_back({at, low, high});
    at = std::min(room.closes[first], next < segments ? room.opens[next] : kNever);
  }
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
