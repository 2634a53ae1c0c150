// SPDX-License-Identifier: Apache-2.0
#include "trace/map_rays.h"

#include <algorithm>
#include <limits>

namespace pdsm {

double first_caster_depth(const MapGrid& grid, const LightSample& sample) {
  if (grid.is_one_of_several && sample.position[2] != 0) return kEmitterShare * grid.near_depth;
  return grid.perspective() ? std::max(kEmitterShare * grid.near_depth - sample.position[2], 0.0) : 0;
}

MapRays::MapRays(const MapGrid& grid, const LightSample& sample)
    : t_near_(static_cast<float>(first_caster_depth(grid, sample))) {
  const auto& s = sample.position;
  const double focus = grid.focus_depth;
  direction_.first[2] = 1;
  for (std::size_t a = 0; a < 2; ++a) {
    const double slope = grid.origin[a] + (0.5 + sample.jitter[a]) * grid.pitch[a];
    if (grid.perspective()) {
      direction_.first[a] = (slope * focus - s[a]) / (focus - s[2]);
      direction_.step[a] = grid.pitch[a] * focus / (focus - s[2]);
      origin_.first[a] = s[a];
    } else {
      origin_.first[a] = slope - s[a] * focus;
      origin_.step[a] = grid.pitch[a];
      direction_.first[a] = s[a];
    }
  }
  if (grid.perspective()) origin_.first[2] = s[2];
}

CentralRay MapRays::ray(std::int32_t x, std::int32_t y) const {
  const auto at = [&](const Linear& linear) {
    return glm::dvec3(linear.first[0] + linear.step[0] * x, linear.first[1] + linear.step[1] * y,
                      linear.first[2]);
  };
  return {at(origin_), at(direction_)};
}

void MapRays::fill(RTCRayHit16& packet, std::int32_t x0, std::int32_t y0) const {
  for (int lane = 0; lane < kMapPacketRays; ++lane) {
    const std::int32_t x = x0 + lane % kPacketEdge, y = y0 + lane / kPacketEdge;
    packet.ray.org_x[lane] = static_cast<float>(origin_.first[0] + origin_.step[0] * x);
    packet.ray.org_y[lane] = static_cast<float>(origin_.first[1] + origin_.step[1] * y);
    packet.ray.org_z[lane] = static_cast<float>(origin_.first[2]);
    packet.ray.dir_x[lane] = static_cast<float>(direction_.first[0] + direction_.step[0] * x);
    packet.ray.dir_y[lane] = static_cast<float>(direction_.first[1] + direction_.step[1] * y);
    packet.ray.dir_z[lane] = 1;
    packet.ray.tnear[lane] = t_near_;
    packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    packet.ray.time[lane] = 0;
    packet.ray.mask[lane] = kCasterMask | kCutoutMask;
    packet.ray.id[lane] = static_cast<unsigned>(lane);
    packet.ray.flags[lane] = 0;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

void store_packet(const RTCRayHit16& packet, const SurfaceBias& bias, float origin_z, std::int32_t x0,
                  std::int32_t y0, SampleMap& map, SlopeBiasStatistics& statistics) {
  alignas(64) float depths[kMapPacketRays], slopes[kMapPacketRays];
  bias.slope_biases(packet, slopes);
  for (int lane = 0; lane < kMapPacketRays; ++lane) {
    const bool hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    const float depth = origin_z + packet.ray.tfar[lane] + bias.constant() + slopes[lane];
    depths[lane] = hit ? depth : std::numeric_limits<float>::infinity();
  }
  map.set_packet(x0, y0, depths);
  for (int lane = 0; lane < kMapPacketRays; ++lane) {
    statistics.sum += static_cast<double>(slopes[lane]);
    statistics.max = std::max(statistics.max, slopes[lane]);
  }
}

}  // namespace pdsm
