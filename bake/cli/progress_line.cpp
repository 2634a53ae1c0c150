// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/streams.h"

namespace pdsm {
namespace {

/// Below this share the time left is a guess not worth showing.
constexpr double kFirstGuess = 0.02;

void write_terminal(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressStyle progress_style(bool quiet) {
  return !quiet && isatty(STDERR_FILENO) != 0 ? ProgressStyle::terminal : ProgressStyle::none;
}

ProgressLine::ProgressLine(ProgressTitle title, ProgressStyle style)
    : title_(std::move(title)), style_(style) {}

ProgressLine::~ProgressLine() {
  if (style_ == ProgressStyle::terminal) write_terminal("\r\x1b[K");
}

void ProgressLine::show(const BakeProgress& progress) {
  if (style_ == ProgressStyle::terminal) show_on_terminal(progress);
  if (style_ == ProgressStyle::json) show_as_json(progress);
}

std::optional<double> ProgressLine::seconds_left(double done) const {
  if (done < kFirstGuess) return std::nullopt;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return elapsed * (1 - done) / done;
}

void ProgressLine::show_on_terminal(const BakeProgress& progress) const {
  const double done = std::clamp(progress.done, 0.0, 1.0);
  const std::string title = title_.trial.empty() ? title_.light : title_.light + ", " + title_.trial;
  std::string line = fmt::format("\r{}: {:<10} {:3.0f}%", title, progress.step, 100 * done);
  if (progress.rays_per_second > 0) line += fmt::format("  {:.1f} Mrays/s", 1e-6 * progress.rays_per_second);
  if (const auto left = seconds_left(done)) line += fmt::format("  {} left", minutes_text(*left));
  write_terminal(line + "\x1b[K");
}

void ProgressLine::show_as_json(const BakeProgress& progress) const {
  const double done = std::clamp(progress.done, 0.0, 1.0);
  nlohmann::ordered_json json{{"light", title_.light}};
  if (!title_.trial.empty()) json["trial"] = title_.trial;
  json["step"] = progress.step;
  json["done"] = done;
  json["rays_per_second"] = nullptr;
  json["seconds_left"] = nullptr;
  if (progress.rays_per_second > 0) json["rays_per_second"] = progress.rays_per_second;
  if (const auto left = seconds_left(done)) json["seconds_left"] = *left;
  write_error_line(json.dump());
}

std::string minutes_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace pdsm
