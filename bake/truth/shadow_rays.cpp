// SPDX-License-Identifier: Apache-2.0
#include "truth/shadow_rays.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "truth/light_points.h"
#include "truth/random.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kPacketSize = 16;  // the widest that Embree has
/// Where a ray begins, as a share of its way to the light point: off the surface it starts on.
constexpr double kRayStart = 1e-4;
/// Depth of the emitter as a share of near (design.md section 7).
constexpr double kEmitterShare = 1e-4;

bool is_caster(const Geometry& geometry) {
  return geometry.casts;
}

}  // namespace

/// Rays from one point to up to 16 light points, `t` from 0 at the point to 1 at the light.
struct ShadowRays::Packet {
  glm::vec3 origin;
  float end;
  std::uint32_t size;
  std::array<glm::vec3, kPacketSize> direction;
};

ShadowRays::ShadowRays(const Scene& scene, const Light& light, double near_depth)
    : light_(light),
      world_to_light_(light_frame(light)),
      light_to_world_(inverse(world_to_light_)),
      emitter_depth_(kEmitterShare * near_depth),
      // Triangles within the emitter are left out rather than cut off by the rays' end, where floats are
      // too coarse to tell a lamp's own face from what lies just before it.
      casters_(scene, is_caster, [this](const std::array<glm::dvec3, 3>& corners) {
        return std::any_of(corners.begin(), corners.end(), [this](const glm::dvec3& corner) {
          return apply(world_to_light_, corner).z > emitter_depth_;
        });
      }) {}

double ShadowRays::attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                               std::uint64_t seed) const {
  assert(samples >= 1);
  const glm::dvec3 in_light = apply(world_to_light_, world_point);
  if (!(in_light.z > emitter_depth_)) return 0;

  Packet packet;
  packet.origin = glm::vec3(world_point - casters_.centre());
  packet.end = static_cast<float>(1 - emitter_depth_ / in_light.z);
  const JitteredGrid grid(samples);
  std::uint64_t blocked = 0;
  for (std::uint32_t first = 0; first < samples; first += kPacketSize) {
    packet.size = std::min(kPacketSize, samples - first);
    for (std::uint32_t i = 0; i < packet.size; ++i) {
      const std::array<double, 2> on_light = light_point(light_, grid.point(first + i, seed));
      packet.direction[i] =
          glm::vec3(apply(light_to_world_, glm::dvec3(on_light[0], on_light[1], 0)) - world_point);
    }
    blocked += static_cast<std::uint64_t>(count_blocked(packet));
    if (samples - first <= kPacketSize) break;  // first + 16 may not fit 32 bits
  }
  return static_cast<double>(blocked) / samples;
}

int ShadowRays::count_blocked(const Packet& packet) const {
  alignas(64) std::array<int, kPacketSize> valid{};
  RTCRay16 rays{};
  for (std::uint32_t i = 0; i < packet.size; ++i) {
    valid[i] = -1;
    rays.org_x[i] = packet.origin.x;
    rays.org_y[i] = packet.origin.y;
    rays.org_z[i] = packet.origin.z;
    rays.dir_x[i] = packet.direction[i].x;
    rays.dir_y[i] = packet.direction[i].y;
    rays.dir_z[i] = packet.direction[i].z;
    rays.tnear[i] = static_cast<float>(kRayStart);
    rays.tfar[i] = packet.end;
    rays.mask[i] = ~0U;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid.data(), casters_.handle(), &context, &rays);

  // Embree marks a blocked ray by a tfar of -inf.
  int blocked = 0;
  for (std::uint32_t i = 0; i < packet.size; ++i) blocked += rays.tfar[i] < 0 ? 1 : 0;
  return blocked;
}

std::vector<double> ShadowRays::attenuations(std::span<const glm::dvec3> world_points, std::uint32_t samples,
                                             std::uint64_t seed, bool same_seed) const {
  std::vector<double> result(world_points.size());
  const auto count = static_cast<std::int64_t>(world_points.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    result[n] = attenuation(world_points[n], samples, same_seed ? seed : hash_bits(seed, n));
  }
  return result;
}

}  // namespace pdsm
