// SPDX-License-Identifier: Apache-2.0
#include "walk/ray_packets.h"

#include <algorithm>
#include <limits>

namespace pdsm {
namespace {

RayPacket make_packet(const MapGrid& grid, const TexelRect& rect, std::span<const float> domain_ends,
                      std::uint32_t i0, std::uint32_t j) {
  const std::uint32_t coarse_x = grid.ratio[0].coarse, coarse_y = grid.ratio[1].coarse;
  const auto width = static_cast<std::uint32_t>(rect.x1 - rect.x0);
  RayPacket packet;
  packet.column = static_cast<std::int32_t>(i0 / coarse_x);
  packet.row = static_cast<std::int32_t>(j / coarse_y);
  packet.phase_x = i0 % coarse_x;
  packet.phase_y = j % coarse_y;
  packet.first_end = std::numeric_limits<float>::infinity();
  packet.last_end = 0;
  packet.domain_end.fill(RayPacket::kUnused);
  for (std::uint32_t lane = 0; lane < RayPacket::kLanes; ++lane) {
    const std::uint32_t i = i0 + lane * coarse_x;
    if (i >= static_cast<std::uint32_t>(rect.x1)) break;
    const std::uint32_t texel =
        (j - static_cast<std::uint32_t>(rect.y0)) * width + (i - static_cast<std::uint32_t>(rect.x0));
    packet.texel[lane] = static_cast<std::uint16_t>(texel);
    packet.domain_end[lane] = domain_ends[texel];
    packet.first_end = std::min(packet.first_end, domain_ends[texel]);
    packet.last_end = std::max(packet.last_end, domain_ends[texel]);
  }
  return packet;
}

}  // namespace

std::vector<RayPacket> make_ray_packets(const MapGrid& grid, const TexelRect& rect,
                                        std::span<const float> domain_ends) {
  const std::uint32_t coarse = grid.ratio[0].coarse;
  std::vector<RayPacket> packets;
  for (auto j = static_cast<std::uint32_t>(rect.y0); j < static_cast<std::uint32_t>(rect.y1); ++j) {
    for (std::uint32_t phase = 0; phase < coarse; ++phase) {
      for (std::uint32_t i = static_cast<std::uint32_t>(rect.x0) + phase;
           i < static_cast<std::uint32_t>(rect.x1); i += coarse * RayPacket::kLanes) {
        packets.push_back(make_packet(grid, rect, domain_ends, i, j));
      }
    }
  }
  return packets;
}

}  // namespace pdsm
