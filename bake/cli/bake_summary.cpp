// SPDX-License-Identifier: Apache-2.0
#include "cli/bake_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pdsm {
namespace {

using Status = LightOutcome::Status;

/// Right-aligned columns behind the light's name and status.
using Cells = std::array<std::string, 6>;
const Cells kTitles{"seconds", "bytes", "rays", "pieces", "kept", "error"};

/// "12/64" blocks that were taken over; of nothing nothing.
std::string kept_text(std::uint64_t kept, std::uint64_t blocks) {
  return blocks > 0 ? fmt::format("{}/{}", kept, blocks) : "-";
}

Cells cells_of(const LightOutcome& outcome) {
  const bool baked = outcome.status == Status::baked, has_map = baked || outcome.status == Status::unchanged;
  return {fmt::format("{:.2f}", outcome.seconds),
          has_map ? std::to_string(outcome.bytes) : "-",
          baked ? std::to_string(outcome.rays) : "-",
          baked ? std::to_string(outcome.pieces) : "-",
          kept_text(outcome.blocks_taken_over, outcome.blocks),
          outcome.error ? fmt::format("{:.5f}", outcome.error->mean_abs_error) : "-"};
}

Cells total_cells(const std::vector<LightOutcome>& outcomes, double seconds) {
  std::uint64_t bytes = 0, rays = 0, pieces = 0, blocks = 0, kept = 0;
  double worst = -1;
  for (const LightOutcome& outcome : outcomes) {
    bytes += outcome.bytes;
    rays += outcome.rays;
    pieces += outcome.pieces;
    blocks += outcome.blocks;
    kept += outcome.blocks_taken_over;
    if (outcome.error) worst = std::max(worst, outcome.error->mean_abs_error);
  }
  return {fmt::format("{:.2f}", seconds), std::to_string(bytes),
          std::to_string(rays),           std::to_string(pieces),
          kept_text(kept, blocks),        worst < 0 ? "-" : fmt::format("{:.5f}", worst)};
}

/// "3 baked, 1 skipped".
std::string counts_text(const std::vector<LightOutcome>& outcomes) {
  std::string text;
  for (const Status status : {Status::baked, Status::unchanged, Status::skipped, Status::failed}) {
    const auto count = std::ranges::count(outcomes, status, &LightOutcome::status);
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, status_name(status));
  }
  return text;
}

}  // namespace

std::vector<std::string> summary_lines(const std::vector<LightOutcome>& outcomes, double seconds) {
  std::size_t name_width = 5, status_width = 9;
  const std::string counts = counts_text(outcomes);
  for (const LightOutcome& outcome : outcomes)
    name_width = std::max(name_width, outcome.job->light->name.size());
  status_width = std::max(status_width, counts.size());
  const auto line = [&](const std::string& name, const std::string& status, const Cells& cells) {
    return fmt::format("{:<{}}  {:<{}}  {:>8}  {:>10}  {:>12}  {:>9}  {:>9}  {:>8}", name, name_width, status,
                       status_width, cells[0], cells[1], cells[2], cells[3], cells[4], cells[5]);
  };
  std::vector<std::string> lines{line("light", "status", kTitles)};
  for (const LightOutcome& outcome : outcomes)
    lines.push_back(line(outcome.job->light->name, status_name(outcome.status), cells_of(outcome)));
  lines.push_back(line("all", counts, total_cells(outcomes, seconds)));
  return lines;
}

}  // namespace pdsm
