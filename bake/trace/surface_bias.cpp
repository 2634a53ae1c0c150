// SPDX-License-Identifier: Apache-2.0
#include "trace/surface_bias.h"

#include <algorithm>
#include <cmath>

#include "trace/receiver_rays.h"

namespace pdsm {
namespace {

bool met(const RTCRayHit16& packet, int lane) {
  return packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
}

}  // namespace

SurfaceBias::SurfaceBias(const EmbreeScene& scene, const MapGrid& grid, const LightSample& sample,
                         const MapBias& bias)
    : scene_(scene),
      constant_(static_cast<float>(bias.constant)),
      limited_from_(static_cast<float>(bias.limited_from)),
      limit_(static_cast<float>(grid.far_depth)),
      parallel_(!grid.perspective()) {
  const double lambda = parallel_ ? 1 : (grid.focus_depth - sample.position[2]) / grid.focus_depth;
  reach_x_ = static_cast<float>(bias.reach[0] * grid.pitch[0] / lambda);
  reach_y_ = static_cast<float>(bias.reach[1] * grid.pitch[1] / lambda);
}

/// On the plane n . P = c the depth along direction d is t = c / (n . d), and d changes with the focus-plane
/// slope a by 1 / lambda (see ray_path.h). Within r texels of pitch p of a hit, n . d shrinks by at most
/// R = (r_x p_x |n_x| + r_y p_y |n_y|) / lambda, so the plane is at most t R / (|n . d| - R) behind it.
/// Parallel rays are moved by r p instead, and d stays: the plane is at most R / |n . d| behind.
float SurfaceBias::of_plane(const RTCRayHit16& packet, int lane) const {
  const float nx = packet.hit.Ng_x[lane], ny = packet.hit.Ng_y[lane], nz = packet.hit.Ng_z[lane];
  const float facing = std::abs(nx * packet.ray.dir_x[lane] + ny * packet.ray.dir_y[lane] + nz);
  const float shrink = reach_x_ * std::abs(nx) + reach_y_ * std::abs(ny);
  const float behind = parallel_ ? shrink : packet.ray.tfar[lane] * shrink;
  const float left = parallel_ ? facing : facing - shrink;
  // Written so that a plane that is seen edge-on within the reach, and a sliver's NaN, take the limit.
  return behind < limit_ * left ? behind / left : limit_;
}

void SurfaceBias::slope_biases(const RTCRayHit16& packet, float* slopes) const {
  bool any_steep = false;
  for (int lane = 0; lane < kLanes; ++lane) {
    slopes[lane] = met(packet, lane) && !is_curve(packet, lane) ? of_plane(packet, lane) : 0.0F;
    any_steep = any_steep || slopes[lane] > limited_from_;
  }
  if (any_steep) keep_before_next_receiver(packet, slopes);
}

bool SurfaceBias::is_curve(const RTCRayHit16& packet, int lane) const {
  return packet.hit.geomID[lane] >= scene_.geometry().meshes.size();
}

void SurfaceBias::keep_before_next_receiver(const RTCRayHit16& packet, float* slopes) const {
  RTCRayHit16 onwards = packet;
  alignas(64) std::array<int, kLanes> valid;
  for (int lane = 0; lane < kLanes; ++lane) {
    valid[static_cast<std::size_t>(lane)] = slopes[lane] > limited_from_ ? -1 : 0;
    const float t = packet.ray.tfar[lane];
    onwards.ray.tnear[lane] = t + std::max(kSameSurface * constant_, kLeastGap * t);
    onwards.ray.tfar[lane] = t + slopes[lane] / kWayToNext;
    onwards.ray.mask[lane] = kReceiverMask;
    onwards.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
  ReceiverContext facing(Heading::from_light);
  // Few lanes of a packet go on, and from unlike depths.
  facing.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid.data(), scene_.handle(), &facing.context, &onwards);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (valid[static_cast<std::size_t>(lane)] == 0 || !met(onwards, lane)) continue;
    slopes[lane] = std::min(slopes[lane], kWayToNext * (onwards.ray.tfar[lane] - packet.ray.tfar[lane]));
  }
}

}  // namespace pdsm
