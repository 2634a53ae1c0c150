// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "events/event_log.h"
#include "trace/sample_map.h"
#include "walk/layer_walk.h"
#include "walk/ray_packets.h"
#include "walk/walk_steps.h"

/// The walk by the shift law: one list of texel offsets serves all rays of a sample, and 16 rays are
/// tested at once.
namespace pdsm {

/// The walk steps of one phase as offsets into a sample map, structure of arrays.
struct StepTable {
  std::vector<std::int32_t> offset;
  std::vector<float> begin, end;  ///< depths
};

/// The tables of all phases of one sample: phase (x, y) at [y * coarse_x + x].
/// Offsets count from the map texel with column = packet column, row = fine_y * packet row.
class ShiftWalk {
 public:
  /// Lists the walk of `sample`, which must obey the shift law.
  void list(const MapGrid& grid, const LightSample& sample, Walk walk);
  /// The map texels that the rays of `rays` (map texels of the PDSM) need.
  [[nodiscard]] TexelRect footprint(const TexelRect& rays) const;
  /// Wants the map packets that the rays of `rays` look at.
  void want_packets(const TexelRect& rays, PacketMask& mask) const;
  /// Makes the offsets fit `map`, which covers the footprint.
  void bind(const SampleMap& map);
  /// Appends the events of all rays of `packets` to `log`.
  void walk(const SampleMap& map, std::span<const RayPacket> packets, EventLog& log) const;
  /// The same of a map with layers, as changes of transmittance. Packets that meet none are walked as above.
  void walk(const LayeredMap& map, std::span<const RayPacket> packets, EventLog& log) const;

  /// Texels visited by a ray of phase 0.
  [[nodiscard]] std::size_t length() const { return phases_.front().steps.size(); }

 private:
  struct Phase {
    std::int64_t base_x = 0, base_y = 0;
    std::vector<WalkStep> steps;
    StepTable table;
  };

  [[nodiscard]] bool meets_layers(const Phase& phase, const LayerMap& layers, const TexelRect& texels) const;
  void walk_lanes(const Phase& phase, const LayeredMap& map, const RayPacket& packet, EventLog& log) const;

  std::array<GridRatio, 2> ratio_{};
  std::vector<Phase> phases_;
};

}  // namespace pdsm
