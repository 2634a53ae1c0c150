// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace pdsm {
namespace {

/// Below this share the time left is a guess not worth showing.
constexpr double kFirstGuess = 0.02;

void write_terminal(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressLine::ProgressLine(std::string title, bool quiet)
    : title_(std::move(title)), shown_(!quiet && isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (shown_) write_terminal("\r\x1b[K");
}

void ProgressLine::show(const BakeProgress& progress) {
  if (!shown_) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double done = std::clamp(progress.done, 0.0, 1.0);
  std::string line = fmt::format("\r{}: {:<10} {:3.0f}%", title_, progress.step, 100 * done);
  if (progress.rays_per_second > 0) line += fmt::format("  {:.1f} Mrays/s", 1e-6 * progress.rays_per_second);
  if (done >= kFirstGuess) line += fmt::format("  {} left", minutes_text(elapsed * (1 - done) / done));
  write_terminal(line + "\x1b[K");
}

std::string minutes_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace pdsm
