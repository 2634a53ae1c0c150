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

/// Depth behind its sample from which on geometry counts: up to there it is the emitter itself. Before a
/// distant light, all of light space counts.
[[nodiscard]] double first_caster_depth(const MapGrid& grid, const LightSample& sample);

/// Rays of one light sample through map texel centres: direction (d_x, d_y, 1), so that t = z - s_z. Those of
/// a distant light begin in the plane z = 0, where light space does.
class MapRays {
 public:
  MapRays(const MapGrid& grid, const LightSample& sample);

  /// The rays of the packet whose lower texel is (x0, y0), their lanes as ids; none has met anything yet.
  void fill(RTCRayHit16& packet, std::int32_t x0, std::int32_t y0) const;

  /// The ray of texel (x, y), before anything is rounded.
  [[nodiscard]] CentralRay ray(std::int32_t x, std::int32_t y) const;

  /// Change per texel along `axis` of a ray's direction, or of its origin where all are parallel.
  [[nodiscard]] double step(std::size_t axis) const { return direction_.step[axis] + origin_.step[axis]; }

  /// Depth at t = 0.
  [[nodiscard]] float origin_z() const { return static_cast<float>(origin_.first[2]); }

 private:
  /// A vector at texel 0's centre, and its change per texel along x and y.
  struct Linear {
    std::array<double, 3> first{};
    std::array<double, 2> step{};
  };
  Linear origin_, direction_;
  float t_near_;
};

/// Stores the biased depths of what a packet's rays met; `origin_z`: s_z.
void store_packet(const RTCRayHit16& packet, const SurfaceBias& bias, float origin_z, std::int32_t x0,
                  std::int32_t y0, SampleMap& map, SlopeBiasStatistics& statistics);

}  // namespace pdsm
