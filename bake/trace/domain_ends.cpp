// SPDX-License-Identifier: Apache-2.0
#include "trace/domain_ends.h"

#include <cassert>
#include <limits>

#include "trace/receiver_rays.h"

namespace pdsm {
namespace {

constexpr std::int32_t kPacketRays = 16;

CentralRay ray_of(const MapGrid& grid, std::int32_t x, std::int32_t y) {
  return grid.ray(grid.center_slope(0, static_cast<std::uint32_t>(x)),
                  grid.center_slope(1, static_cast<std::uint32_t>(y)));
}

void fill_packet(RTCRayHit16& packet, int* valid, const MapGrid& grid, std::int32_t x0, std::int32_t x1,
                 std::int32_t y) {
  const double start = receiver_ray_start(grid);
  for (int lane = 0; lane < kPacketRays; ++lane) {
    valid[lane] = x0 + lane < x1 ? -1 : 0;
    const RayToLight ray = ray_to_light(ray_of(grid, x0 + lane, y), start);
    packet.ray.org_x[lane] = ray.origin.x;
    packet.ray.org_y[lane] = ray.origin.y;
    packet.ray.org_z[lane] = ray.origin.z;
    packet.ray.dir_x[lane] = ray.direction.x;
    packet.ray.dir_y[lane] = ray.direction.y;
    packet.ray.dir_z[lane] = ray.direction.z;
    packet.ray.tnear[lane] = 0;
    packet.ray.tfar[lane] = static_cast<float>(start);
    packet.ray.time[lane] = 0;
    packet.ray.mask[lane] = kReceiverMask;
    packet.ray.flags[lane] = 0;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

float end_depth(const EmbreeScene& scene, const MapGrid& grid, const RTCRayHit16& packet, int lane,
                std::int32_t x, std::int32_t y) {
  if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return std::numeric_limits<float>::infinity();
  const LightSpaceMesh& mesh = scene.geometry().meshes[packet.hit.geomID[lane]];
  const PlaneOnRay plane = plane_on_ray(mesh, packet.hit.primID[lane], grid, ray_of(grid, x, y));
  const double traced = receiver_ray_start(grid) - static_cast<double>(packet.ray.tfar[lane]);
  return static_cast<float>(surface_depth(grid, plane, traced));
}

}  // namespace

void find_domain_ends(const EmbreeScene& scene, const MapGrid& grid, const TexelRect& rect,
                      std::span<float> ends) {
  assert(ends.size() == rect.area());
  ReceiverContext receiver(Heading::to_light);
  alignas(64) int valid[kPacketRays];
  RTCRayHit16 packet;
  std::size_t next = 0;
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; x += kPacketRays) {
      fill_packet(packet, valid, grid, x, rect.x1, y);
      rtcIntersect16(valid, scene.handle(), &receiver.context, &packet);
      for (std::int32_t lane = 0; lane < kPacketRays && x + lane < rect.x1; ++lane) {
        ends[next++] = end_depth(scene, grid, packet, lane, x + lane, y);
      }
    }
  }
}

}  // namespace pdsm
