// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace pdsm {

/// Carries the first exception out of a parallel region, which none may leave by itself. After a failure
/// the remaining work is skipped.
class ParallelFailure {
 public:
  template <typename Work>
  void guard(Work&& work) {
    if (failed_.load(std::memory_order_relaxed)) return;
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failed_.exchange(true)) first_ = std::current_exception();
    }
  }

  /// Call behind the region, from one thread.
  void rethrow() {
    if (failed_.exchange(false)) std::rethrow_exception(first_);
  }

 private:
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr first_;
};

}  // namespace pdsm
