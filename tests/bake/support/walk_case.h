// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "events/event_log.h"
#include "pdsm/bake/bake.h"
#include "support/random.h"
#include "trace/sample_map.h"
#include "walk/map_grid.h"
#include "walk/ray_path.h"

namespace pdsm::test {

/// A grid, a light sample and a block of rays, drawn at random.
struct WalkCase {
  MapGrid grid;
  LightSample sample;
  TexelRect rect;                  ///< rays, in texels of the map
  std::vector<float> domain_ends;  ///< one a ray, row by row
};

/// Which light samples are drawn.
enum class SamplePlane { planar, tilted, distant };

/// Of a distant light: orthographic.
[[nodiscard]] MapGrid random_grid(Random& random, SamplePlane plane = SamplePlane::planar);
/// Offsets of zero, along an axis, along a diagonal, or any; jitter of zero, the extremes, or any.
[[nodiscard]] LightSample random_sample(Random& random, const MapGrid& grid, SamplePlane plane);
[[nodiscard]] WalkCase random_walk_case(Random& random, SamplePlane plane);

/// Depths at which walks make decisions: borders of walk steps of some rays. Ties with them are what a
/// walk could get wrong.
[[nodiscard]] std::vector<float> border_depths(const WalkCase& c, Walk walk);

/// Fills all texels of `map`, which covers the case's footprint, with random depths: some infinite, some
/// in plateaus, some exactly at `borders`.
void fill_randomly(Random& random, const WalkCase& c, const std::vector<float>& borders, SampleMap& map);

/// Domain ends: infinite, before near, within, exactly at `borders`.
void draw_domain_ends(Random& random, const std::vector<float>& borders, WalkCase& c);

/// A logged event without its texel.
struct DepthEvent {
  float depth = 0;
  int change = 0;  ///< +1 blocked, -1 unblocked

  friend auto operator<=>(const DepthEvent&, const DepthEvent&) = default;
};

/// The events of each texel in the order in which they were logged.
[[nodiscard]] std::vector<std::vector<DepthEvent>> events_by_texel(const EventLog& log, std::size_t texels);

[[nodiscard]] inline std::size_t texel_count(const TexelRect& rect) {
  return static_cast<std::size_t>(rect.x1 - rect.x0) * static_cast<std::size_t>(rect.y1 - rect.y0);
}

}  // namespace pdsm::test
