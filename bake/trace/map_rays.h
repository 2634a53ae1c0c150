// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

#include "pdsm/format/penumbra_map.h"
#include "trace/sample_map.h"
#include "trace/surface_bias.h"
#include "walk/map_grid.h"

/// Packets of rays through the texels of sample maps, and what their hits leave in a map.
namespace pdsm {

inline constexpr int kMapPacketRays = kPacketEdge * kPacketEdge;
static_assert(kMapPacketRays == SurfaceBias::kLanes);

/// Depth behind its sample from which on geometry counts: up to there it is the emitter itself.
[[nodiscard]] double first_caster_depth(const MapGrid& grid, const LightSample& sample);

/// Rays of one light sample through map texel centres: direction (d_x, d_y, 1), so that t = z - s_z.
class MapRays {
 public:
  MapRays(const MapGrid& grid, const LightSample& sample);

  /// The rays of the packet whose lower texel is (x0, y0); none has met anything yet.
  void fill(RTCRayHit16& packet, std::int32_t x0, std::int32_t y0) const;

 private:
  LightSample sample_;
  std::array<double, 2> first_{}, step_{};  // direction of texel 0's centre, change per texel
  float t_near_;
};

/// Stores the biased depths of what a packet's rays met; `origin_z`: s_z.
void store_packet(const RTCRayHit16& packet, const SurfaceBias& bias, float origin_z, std::int32_t x0,
                  std::int32_t y0, SampleMap& map, SlopeBiasStatistics& statistics);

}  // namespace pdsm
