// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "pdsm/bake/bake.h"

namespace pdsm {

/// One line on stderr, rewritten as a bake goes on, when stderr is a terminal: step, share done, rays a
/// second, time left. Gone when the object is.
class ProgressLine {
 public:
  /// `title` begins the line. Shows nothing when `quiet`, or where stderr is no terminal.
  ProgressLine(std::string title, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const BakeProgress& progress);

 private:
  std::string title_;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds as m:ss.
[[nodiscard]] std::string minutes_text(double seconds);

}  // namespace pdsm
