// SPDX-License-Identifier: Apache-2.0
#include "walk/shift_walk.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "walk/packet_kernel.h"

namespace pdsm {
namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return a % b < 0 ? quotient - 1 : quotient;
}

/// First map texel under ray `ray` of phase 0.
std::int64_t map_texel(const GridRatio& ratio, std::int32_t ray) {
  return std::int64_t{ray} / ratio.coarse * ratio.fine;
}

/// The map texels under the lanes of a packet that are in use, of phase 0.
TexelRect base_texels(const std::array<GridRatio, 2>& ratio, const RayPacket& packet) {
  std::int32_t first = RayPacket::kLanes, last = 0;
  for (std::int32_t lane = 0; lane < static_cast<std::int32_t>(RayPacket::kLanes); ++lane) {
    if (packet.domain_end[static_cast<std::size_t>(lane)] == RayPacket::kUnused) continue;
    first = std::min(first, lane);
    last = lane;
  }
  const auto fine_x = static_cast<std::int32_t>(ratio[0].fine);
  const std::int32_t y = packet.row * static_cast<std::int32_t>(ratio[1].fine);
  return {(packet.column + first) * fine_x, y, (packet.column + last) * fine_x + 1, y + 1};
}

}  // namespace

void ShiftWalk::list(const MapGrid& grid, const LightSample& sample, Walk walk) {
  assert(obeys_shift_law(grid, sample));
  ratio_ = grid.ratio;
  phases_.resize(std::size_t{ratio_[0].coarse} * ratio_[1].coarse);
  for (std::uint32_t y = 0; y < ratio_[1].coarse; ++y) {
    for (std::uint32_t x = 0; x < ratio_[0].coarse; ++x) {
      Phase& phase = phases_[std::size_t{y} * ratio_[0].coarse + x];
      const RayPath path = make_ray_path(grid, sample, x, y);
      phase.base_x = path.base[0];
      phase.base_y = path.base[1];
      list_walk_steps(path, walk, phase.steps);
    }
  }
}

TexelRect ShiftWalk::footprint(const TexelRect& rays) const {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  std::int64_t x0 = kMost, y0 = kMost, x1 = -kMost, y1 = -kMost;
  for (const Phase& phase : phases_) {
    for (const WalkStep& step : phase.steps) {
      x0 = std::min(x0, phase.base_x + step.dx);
      x1 = std::max(x1, phase.base_x + step.dx);
      y0 = std::min(y0, phase.base_y + step.dy);
      y1 = std::max(y1, phase.base_y + step.dy);
    }
  }
  return {static_cast<std::int32_t>(map_texel(ratio_[0], rays.x0) + x0),
          static_cast<std::int32_t>(map_texel(ratio_[1], rays.y0) + y0),
          static_cast<std::int32_t>(map_texel(ratio_[0], rays.x1 - 1) + x1 + 1),
          static_cast<std::int32_t>(map_texel(ratio_[1], rays.y1 - 1) + y1 + 1)};
}

void ShiftWalk::want_packets(const TexelRect& rays, PacketMask& mask) const {
  for (const Phase& phase : phases_) {
    const auto x0 = static_cast<std::int32_t>(map_texel(ratio_[0], rays.x0) + phase.base_x);
    const auto y0 = static_cast<std::int32_t>(map_texel(ratio_[1], rays.y0) + phase.base_y);
    const auto x1 = static_cast<std::int32_t>(map_texel(ratio_[0], rays.x1 - 1) + phase.base_x + 1);
    const auto y1 = static_cast<std::int32_t>(map_texel(ratio_[1], rays.y1 - 1) + phase.base_y + 1);
    for (const WalkStep& step : phase.steps)
      mask.want({x0 + step.dx, y0 + step.dy, x1 + step.dx, y1 + step.dy});
  }
}

void ShiftWalk::bind(const SampleMap& map) {
  const std::int64_t interleave = map.interleave();
  for (Phase& phase : phases_) {
    const std::size_t count = phase.steps.size();
    phase.table.offset.resize(count);
    phase.table.begin.resize(count);
    phase.table.end.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
      const WalkStep& step = phase.steps[n];
      const std::int64_t x = phase.base_x + step.dx - map.rect().x0,
                         y = phase.base_y + step.dy - map.rect().y0;
      const std::int64_t column = floor_div(x, interleave);
      const std::int64_t offset = y * map.pitch() + (x - column * interleave) * map.plane() + column;
      phase.table.offset[n] = static_cast<std::int32_t>(offset);
      phase.table.begin[n] = step.begin;
      phase.table.end[n] = step.end;
    }
  }
}

void ShiftWalk::walk(const SampleMap& map, std::span<const RayPacket> packets, EventLog& log) const {
  const std::int64_t row_pitch = map.pitch() * ratio_[1].fine;
  // Packets of one phase follow each other, so each run of them is one call of the kernel.
  std::size_t begin = 0;
  while (begin < packets.size()) {
    const std::uint32_t x = packets[begin].phase_x, y = packets[begin].phase_y;
    std::size_t end = begin + 1;
    while (end < packets.size() && packets[end].phase_x == x && packets[end].phase_y == y) ++end;
    const StepTable& table = phases_[std::size_t{y} * ratio_[0].coarse + x].table;
    walk_ray_packets(table, map.data(), row_pitch, packets.subspan(begin, end - begin), log);
    begin = end;
  }
}

void ShiftWalk::walk(const LayeredMap& map, std::span<const RayPacket> packets, EventLog& log) const {
  const std::int64_t row_pitch = map.opaque.pitch() * ratio_[1].fine;
  for (const RayPacket& packet : packets) {
    const Phase& phase = phases_[std::size_t{packet.phase_y} * ratio_[0].coarse + packet.phase_x];
    if (meets_layers(phase, map.layers, base_texels(ratio_, packet)))
      walk_lanes(phase, map, packet, log);
    else
      walk_ray_packets(phase.table, map.opaque.data(), row_pitch, {&packet, 1}, log);
  }
}

bool ShiftWalk::meets_layers(const Phase& phase, const LayerMap& layers, const TexelRect& texels) const {
  const auto base_x = static_cast<std::int32_t>(phase.base_x),
             base_y = static_cast<std::int32_t>(phase.base_y);
  return std::ranges::any_of(phase.steps, [&](const WalkStep& step) {
    const std::int32_t dx = base_x + step.dx, dy = base_y + step.dy;
    return layers.any_within({texels.x0 + dx, texels.y0 + dy, texels.x1 + dx, texels.y1 + dy});
  });
}

void ShiftWalk::walk_lanes(const Phase& phase, const LayeredMap& map, const RayPacket& packet,
                           EventLog& log) const {
  const std::int64_t y = std::int64_t{packet.row} * ratio_[1].fine + phase.base_y;
  for (std::uint32_t lane = 0; lane < RayPacket::kLanes; ++lane) {
    if (packet.domain_end[lane] == RayPacket::kUnused) continue;
    const std::int64_t x = (std::int64_t{packet.column} + lane) * ratio_[0].fine + phase.base_x;
    walk_layers(map, phase.steps, x, y, packet.texel[lane], packet.domain_end[lane], log);
  }
}

}  // namespace pdsm
