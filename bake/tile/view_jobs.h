// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "scene/scene_channels.h"
#include "tile/bake_facts.h"
#include "tile/bake_job.h"
#include "tile/block_grid.h"

/// A map of several views, or channels, is baked one after the other; one of a single view and channel is a
/// list of one.
namespace pdsm {

/// In the order of the map's images: all channels of a view, then the next view.
template <typename Setup>
using ViewList = std::vector<std::unique_ptr<Setup>>;

/// Puts them in order, and tells them what they have in common: how many channels the map has, and its
/// coding.
template <typename Setup>
void finish_views(ViewList<Setup>& views, std::uint32_t channels) {
  const auto place = [](const auto& setup) { return std::pair(setup->part.view, setup->part.channel); };
  std::ranges::sort(views, {}, place);
  std::uint32_t depth_bits = 0;
  for (const auto& setup : views) depth_bits = std::max(depth_bits, setup->rules.coding.depth_bits);
  for (const auto& setup : views) {
    setup->channels = channels;
    if (setup->rules.coding.depth_bits != depth_bits) setup->make_rules(depth_bits);
  }
}

/// The setups, or jobs, of all channels of all views of a light's map: of red, green and blue where the light
/// is coloured or sees casters that are, else one. `more`: what the constructor takes besides.
template <typename Setup, typename... More>
[[nodiscard]] ViewList<Setup> make_views(const Scene& scene, const Light& light, const BakeOptions& options,
                                         const More&... more) {
  ViewList<Setup> views;
  const std::uint32_t count = std::max(1U, view_count(light));
  const auto make = [&](ViewChannel part) {
    views.push_back(std::make_unique<Setup>(scene, light, options, more..., part));
  };
  bool coloured = is_coloured(light);
  for (std::uint32_t view = 0; view < count; ++view) {
    make({view, 0});
    coloured = coloured || views.back()->light_space.is_coloured();
  }
  for (std::uint32_t channel = 1; coloured && channel < kColourChannels; ++channel)
    for (std::uint32_t view = 0; view < count; ++view) make({view, channel});
  finish_views(views, coloured ? kColourChannels : 1);
  return views;
}

using ViewJobs = ViewList<BakeJob>;

/// Blocks of level 0 before those of each job, and of all jobs at the end.
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

/// The callbacks of one job of `count`.
[[nodiscard]] BakeCallbacks view_callbacks(const BakeCallbacks& callbacks, std::size_t job,
                                           std::size_t count);

}  // namespace pdsm
