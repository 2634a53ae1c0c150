// SPDX-License-Identifier: Apache-2.0
#include "trace/domain_ends.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

constexpr std::int32_t kPacketRays = 16;
/// Rays start this share of far behind far, so that a surface at far is met.
constexpr double kBehindFar = 1e-3;

/// Rejects surfaces of closed meshes that face away from the light. Rays run towards the light, so a
/// light-facing surface is met from behind: its outward normal points along the ray.
void keep_light_facing(const RTCFilterFunctionNArguments* args) {
  const auto* mesh = static_cast<const LightSpaceMesh*>(args->geometryUserPtr);
  if (!mesh->closed) return;
  const unsigned n = args->N;
  for (unsigned lane = 0; lane < n; ++lane) {
    if (args->valid[lane] != -1) continue;
    const float along = RTCRayN_dir_x(args->ray, n, lane) * RTCHitN_Ng_x(args->hit, n, lane) +
                        RTCRayN_dir_y(args->ray, n, lane) * RTCHitN_Ng_y(args->hit, n, lane) +
                        RTCRayN_dir_z(args->ray, n, lane) * RTCHitN_Ng_z(args->hit, n, lane);
    if (along <= 0) args->valid[lane] = 0;
  }
}

/// Depth at which the ray (u, v, 1) z meets the plane of a triangle.
double plane_depth(const LightSpaceMesh& mesh, unsigned triangle, double u, double v) {
  const glm::uvec3 t = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  return glm::dot(normal, a) / glm::dot(normal, glm::dvec3(u, v, 1));
}

void fill_packet(RTCRayHit16& packet, int* valid, const MapGrid& grid, std::int32_t x0, std::int32_t x1,
                 std::int32_t y) {
  const double start = grid.far_depth * (1 + kBehindFar);
  for (int lane = 0; lane < kPacketRays; ++lane) {
    valid[lane] = x0 + lane < x1 ? -1 : 0;
    const double u = grid.center_slope(0, static_cast<std::uint32_t>(x0 + lane));
    const double v = grid.center_slope(1, static_cast<std::uint32_t>(y));
    packet.ray.org_x[lane] = static_cast<float>(u * start);
    packet.ray.org_y[lane] = static_cast<float>(v * start);
    packet.ray.org_z[lane] = static_cast<float>(start);
    packet.ray.dir_x[lane] = static_cast<float>(-u);
    packet.ray.dir_y[lane] = static_cast<float>(-v);
    packet.ray.dir_z[lane] = -1;
    packet.ray.tnear[lane] = 0;
    packet.ray.tfar[lane] = static_cast<float>(start);
    packet.ray.time[lane] = 0;
    packet.ray.mask[lane] = kReceiverMask;
    packet.ray.flags[lane] = 0;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

/// The plane's depth, unless the triangle is so grazing that only the traced distance makes sense.
float end_depth(const EmbreeScene& scene, const MapGrid& grid, const RTCRayHit16& packet, int lane,
                std::int32_t x, std::int32_t y) {
  if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return std::numeric_limits<float>::infinity();
  const LightSpaceMesh& mesh = scene.geometry().meshes[packet.hit.geomID[lane]];
  const double traced = grid.far_depth * (1 + kBehindFar) - static_cast<double>(packet.ray.tfar[lane]);
  const double exact = plane_depth(mesh, packet.hit.primID[lane], grid.center_slope(0, static_cast<std::uint32_t>(x)),
                                   grid.center_slope(1, static_cast<std::uint32_t>(y)));
  const bool agree = std::abs(exact - traced) <= kBehindFar * grid.far_depth;
  return static_cast<float>(agree ? exact : traced);
}

}  // namespace

void find_domain_ends(const EmbreeScene& scene, const MapGrid& grid, const TexelRect& rect,
                      std::span<float> ends) {
  assert(ends.size() == static_cast<std::size_t>(rect.x1 - rect.x0) * static_cast<std::size_t>(rect.y1 - rect.y0));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.filter = keep_light_facing;
  alignas(64) int valid[kPacketRays];
  RTCRayHit16 packet;
  std::size_t next = 0;
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; x += kPacketRays) {
      fill_packet(packet, valid, grid, x, rect.x1, y);
      rtcIntersect16(valid, scene.handle(), &context, &packet);
      for (std::int32_t lane = 0; lane < kPacketRays && x + lane < rect.x1; ++lane) {
        ends[next++] = end_depth(scene, grid, packet, lane, x + lane, y);
      }
    }
  }
}

}  // namespace pdsm
