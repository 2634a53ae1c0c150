// SPDX-License-Identifier: Apache-2.0
#include "tile/slope_limit.h"

#include <cmath>

namespace pdsm {
namespace {

/// Slopes that add so many constants, four texels by default, are steep: planes seen edge-on are among them.
constexpr double kSteep = 16;
/// Packets of the grid along each axis.
constexpr std::int32_t kGridPackets = 48;
/// Share of rays whose gentle slope would be changed from which on these are limited.
constexpr double kWorthLimiting = 0.01;

/// First map texel of packet `n` of the grid along `axis`.
std::int32_t packet_texel(const MapGrid& grid, std::size_t axis, std::int32_t n) {
  const double texels = grid.texels[axis] * grid.ratio[axis].maps_per_texel();
  return static_cast<std::int32_t>(texels * n / kGridPackets) / kPacketEdge * kPacketEdge;
}

}  // namespace

SlopeLimit find_slope_limit(const EmbreeScene& scene, const MapGrid& grid, Walk walk, double constant) {
  const LightSample centre = grid.centre_sample();
  const MapBias every = sample_bias(grid, walk, true, {constant, constant}, centre);
  const MapBias steep = sample_bias(grid, walk, true, {constant, kSteep * constant}, centre);
  SampleMap limited, free;
  SlopeBiasStatistics unused;
  std::uint64_t met = 0, changed = 0;
  for (std::int32_t packet = 0; packet < kGridPackets * kGridPackets; ++packet) {
    const std::int32_t x0 = packet_texel(grid, 0, packet % kGridPackets);
    const std::int32_t y0 = packet_texel(grid, 1, packet / kGridPackets);
    const TexelRect rect{x0, y0, x0 + kPacketEdge, y0 + kPacketEdge};
    limited.reset(rect, 1);
    free.reset(rect, 1);
    trace_sample_map(scene, grid, centre, every, nullptr, limited, unused);
    trace_sample_map(scene, grid, centre, steep, nullptr, free, unused);
    for (std::int32_t n = 0; n < kPacketEdge * kPacketEdge; ++n) {
      const std::int32_t x = x0 + n % kPacketEdge, y = y0 + n / kPacketEdge;
      met += std::isfinite(free.at(x, y)) ? 1 : 0;
      changed += limited.at(x, y) < free.at(x, y) ? 1 : 0;
    }
  }
  const bool thin_gaps = static_cast<double>(changed) > kWorthLimiting * static_cast<double>(met);
  return {thin_gaps ? constant : kSteep * constant, thin_gaps};
}

}  // namespace pdsm
