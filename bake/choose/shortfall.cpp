// SPDX-License-Identifier: Apache-2.0
#include "choose/shortfall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "choose/search.h"
#include "choose/verdict.h"

namespace pdsm {
namespace {

std::string bytes_text(double bytes) {
  return bytes < 1e6 ? fmt::format("{:.1f} kB", 1e-3 * bytes) : fmt::format("{:.2f} MB", 1e-6 * bytes);
}

/// The error goal alone is too much for any settings.
std::string too_exact(const Laws& laws, const ChoiceSpace& space, const Goals& goals, const Limits& limits) {
  const std::optional<Settings> best =
      most_exact_settings(laws, space, {.work = limits.work, .edge = limits.edge});
  const char* limit = "";
  if (std::isfinite(limits.edge)) {
    limit = " (--memory allows no more texels)";
  } else if (std::isfinite(limits.work)) {
    limit = " (a --time-budget would let it take longer)";
  }
  return fmt::format("--target-error: {} can't be reached with certainty: {} would leave about {:.2g}{}",
                     *goals.target_error, settings_text(*best), laws.error(*best), limit);
}

/// What the cheapest settings take that hold everything but one budget, with the smaller of both.
template <typename Taken>
std::string with_error(const Goals& goals, const Taken& taken) {
  return goals.target_error ? fmt::format("an error of {} would take about {}", *goals.target_error, taken)
                            : fmt::format("the smallest map would take about {}", taken);
}

}  // namespace

std::string explain_shortfall(const Laws& laws, const ChoiceSpace& space, const Goals& goals,
                              const Limits& limits) {
  Limits error_alone;
  error_alone.error = limits.error;
  error_alone.edge = limits.edge;
  error_alone.work = limits.work;
  const std::optional<Settings> unbounded = choose_settings(laws, space, error_alone, Wish::least_cost);
  if (!unbounded) return too_exact(laws, space, goals, limits);
  Limits and_bytes = error_alone;
  and_bytes.bytes = limits.bytes;
  const std::optional<Settings> small = choose_settings(laws, space, and_bytes, Wish::least_cost);
  if (!small) {
    return "--size-budget: " +
           with_error(goals, bytes_text(laws.bytes(*unbounded) + static_cast<double>(kMetadataBytes)));
  }
  return "--time-budget: " + with_error(goals, fmt::format("{:.2g} s more", laws.seconds(*small)));
}

std::string explain_miss(const Goals& goals, std::span<const Trial> tries) {
  if (!goals.target_error) {
    const auto smallest = std::min_element(tries.begin(), tries.end(),
                                           [](const Trial& a, const Trial& b) { return a.bytes < b.bytes; });
    return fmt::format("--size-budget: reached only {} bytes without metadata ({})", smallest->bytes,
                       settings_text(smallest->settings));
  }
  const auto best = std::min_element(tries.begin(), tries.end(), [](const Trial& a, const Trial& b) {
    return a.mean_abs_error() < b.mean_abs_error();
  });
  return fmt::format("--target-error: reached only {:.5f}, for which others may measure {:.5f} ({})",
                     best->mean_abs_error(), best->mean_abs_error() + error_margin(*best),
                     settings_text(best->settings));
}

}  // namespace pdsm
