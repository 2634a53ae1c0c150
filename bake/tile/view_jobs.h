// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "tile/bake_facts.h"
#include "tile/bake_job.h"
#include "tile/block_grid.h"

/// A map of several views is baked view after view; one of a single view is a list of one.
namespace pdsm {

template <typename Setup>
using ViewList = std::vector<std::unique_ptr<Setup>>;

/// The setups, or jobs, of all views of a light's map. `more`: what the constructor takes besides.
template <typename Setup, typename... More>
[[nodiscard]] ViewList<Setup> make_views(const Scene& scene, const Light& light, const BakeOptions& options,
                                         const More&... more) {
  ViewList<Setup> views;
  const std::uint32_t count = std::max(1U, view_count(light));
  for (std::uint32_t view = 0; view < count; ++view)
    views.push_back(std::make_unique<Setup>(scene, light, options, more..., view));
  std::uint32_t depth_bits = 0;
  for (const auto& setup : views) depth_bits = std::max(depth_bits, setup->rules.coding.depth_bits);
  for (const auto& setup : views)
    if (setup->rules.coding.depth_bits != depth_bits) setup->make_rules(depth_bits);
  return views;
}

using ViewJobs = ViewList<BakeJob>;

/// Blocks of level 0 before those of each view, and of all views at the end.
[[nodiscard]] inline std::vector<std::uint32_t> first_blocks(const ViewJobs& jobs) {
  std::vector<std::uint32_t> firsts{0};
  for (const auto& job : jobs) firsts.push_back(firsts.back() + block_count(job->grid));
  return firsts;
}

[[nodiscard]] inline MapFacts gather_facts(const ViewJobs& jobs) {
  MapFacts facts;
  for (const auto& job : jobs) facts.push_back(gather_facts(*job));
  return facts;
}

/// The callbacks of one view's bake.
[[nodiscard]] BakeCallbacks view_callbacks(const BakeCallbacks& callbacks, std::size_t view,
                                           std::size_t count);

}  // namespace pdsm
