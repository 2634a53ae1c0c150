// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

/// Visibility events on their way from the walks to the accumulation.
namespace pdsm {

/// A visibility event of one light sample, packed: texel within its block, depth, and whether the sample
/// gets blocked or unblocked there. Depths are positive floats, whose bits order as they do, and which
/// leave the sign bit free.
using PackedEvent = std::uint64_t;

[[nodiscard]] inline PackedEvent pack_event(std::uint32_t texel, float depth, bool unblocks) {
  return (static_cast<PackedEvent>(texel) << 32) | (std::bit_cast<std::uint32_t>(depth) << 1) |
         static_cast<std::uint32_t>(unblocks);
}

/// Lower half of a packed event: orders by depth.
using EventKey = std::uint32_t;
[[nodiscard]] inline EventKey event_key(PackedEvent event) {
  return static_cast<EventKey>(event);
}
[[nodiscard]] inline std::uint32_t event_texel(PackedEvent event) {
  return static_cast<std::uint32_t>(event >> 32);
}
[[nodiscard]] inline float key_depth(EventKey key) {
  return std::bit_cast<float>(key >> 1);
}
[[nodiscard]] inline bool key_unblocks(EventKey key) {
  return (key & 1) != 0;
}

/// Counts the bytes of all logs of a tile against a limit.
class EventBudget {
 public:
  explicit EventBudget(std::uint64_t limit) : limit_(limit) {}
  void take(std::uint64_t bytes) {
    const std::uint64_t used = used_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
    if (used > limit_) exceeded_.store(true, std::memory_order_relaxed);
  }
  /// Counts it as exceeded from now on.
  void give_up() { exceeded_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t limit() const { return limit_; }
  [[nodiscard]] bool exceeded() const { return exceeded_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t used() const { return used_.load(std::memory_order_relaxed); }

 private:
  std::uint64_t limit_;
  std::atomic<std::uint64_t> used_{0};
  std::atomic<bool> exceeded_{false};
};

/// Append-only list of the events that one thread finds in one block. Pages, so that growing copies
/// nothing. Once the budget is exceeded, events are dropped: the tile is going to be thrown away.
class EventLog {
 public:
  static constexpr std::size_t kPageEvents = 1024, kPageBytes = kPageEvents * sizeof(PackedEvent);

  explicit EventLog(EventBudget* budget) : budget_(budget) {}

  /// Room for `count` <= kPageEvents events in a row; commit() says how many were written.
  [[nodiscard]] PackedEvent* reserve(std::size_t count) {
    if (pages_.empty() || fill_ + count > kPageEvents) open_page();
    return pages_.back().events.get() + fill_;
  }
  void commit(std::size_t count) { fill_ += count; }

  [[nodiscard]] std::uint64_t size() const {
    std::uint64_t total = fill_;
    for (std::size_t i = 0; i + 1 < pages_.size(); ++i) total += pages_[i].count;
    return total;
  }

  template <typename Visitor>
  void for_each(Visitor&& visit) const {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      const std::size_t count = i + 1 == pages_.size() ? fill_ : pages_[i].count;
      for (std::size_t n = 0; n < count; ++n) visit(pages_[i].events[n]);
    }
  }

  void clear() {
    pages_.clear();
    fill_ = 0;
  }

 private:
  struct Page {
    std::unique_ptr<PackedEvent[]> events;
    std::size_t count = 0;
  };

  void open_page() {
    if (budget_->exceeded() && !pages_.empty()) {
      fill_ = 0;
      return;
    }
    if (!pages_.empty()) pages_.back().count = fill_;
    pages_.push_back({std::make_unique_for_overwrite<PackedEvent[]>(kPageEvents), 0});
    budget_->take(kPageBytes);
    fill_ = 0;
  }

  EventBudget* budget_;
  std::vector<Page> pages_;
  std::size_t fill_ = 0;
};

}  // namespace pdsm
