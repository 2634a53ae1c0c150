// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "pdsm/bake/bake.h"

namespace pdsm {

enum class ProgressStyle {
  none,
  terminal,  ///< one line, rewritten as a bake goes on and gone at its end
  json       ///< one JSON object a line (docs/commands.md)
};

/// What suits stderr: nothing where it is no terminal, or when `quiet`.
[[nodiscard]] ProgressStyle progress_style(bool quiet);

/// What is going on.
struct ProgressTitle {
  std::string light;
  std::string trial;  ///< which of several bakes of the light; may be empty
};

/// Tells on stderr how far a bake is: step, share done, rays a second, time left.
class ProgressLine {
 public:
  ProgressLine(ProgressTitle title, ProgressStyle style);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const BakeProgress& progress);

 private:
  void show_on_terminal(const BakeProgress& progress) const;
  void show_as_json(const BakeProgress& progress) const;
  /// Empty while it would be a guess not worth showing.
  [[nodiscard]] std::optional<double> seconds_left(double done) const;

  ProgressTitle title_;
  ProgressStyle style_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds as m:ss.
[[nodiscard]] std::string minutes_text(double seconds);

}  // namespace pdsm
