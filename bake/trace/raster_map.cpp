// SPDX-License-Identifier: Apache-2.0
#include "trace/raster_map.h"

#include <algorithm>
#include <limits>

#include "trace/cutout_holes.h"
#include "trace/hidden_chunks.h"
#include "trace/map_rays.h"

namespace pdsm {
namespace {

/// Packets.
constexpr std::int32_t kFetchedAhead = 4;

std::span<const std::uint32_t> slots_of_chunk(std::span<const std::uint32_t> slots, std::size_t chunk) {
  if (slots.empty()) return slots;
  const std::size_t first = chunk * CasterTriangles::kChunk, last = first + CasterTriangles::kChunk;
  const auto begin = std::lower_bound(slots.begin(), slots.end(), first);
  return {begin, std::lower_bound(begin, slots.end(), last)};
}

/// Turns the rays of a packet into those that have met what the image holds. Depths are worked out for all
/// lanes together, and z = 1 / (1/F - k) is the distance along rays of samples in the light's plane.
void take_hits(const CasterTriangles& casters, const DepthImage& image, std::int32_t x0, std::int32_t y0,
               RTCRayHit16& packet) {
  const double inverse_focus = 1 / casters.focus_depth;
  constexpr float kNone = std::numeric_limits<float>::infinity();
  alignas(64) std::uint64_t keys[kMapPacketRays];
  alignas(64) double depths[kMapPacketRays];
  for (int lane = 0; lane < kMapPacketRays; ++lane) {
    keys[lane] = image.key(x0 + lane % kPacketEdge, y0 + lane / kPacketEdge);
    depths[lane] = inverse_focus - static_cast<double>(key_k(keys[lane]));
  }
  for (double& depth : depths) depth = 1 / depth;
  for (int lane = 0; lane < kMapPacketRays; ++lane)
    packet.ray.tfar[lane] = keys[lane] == DepthImage::kNothing ? kNone : static_cast<float>(depths[lane]);
  for (int lane = 0; lane < kMapPacketRays; ++lane) {
    if (keys[lane] == DepthImage::kNothing) continue;
    const CasterTriangles::Surface& surface = casters.surfaces[key_id(keys[lane])];
    packet.hit.Ng_x[lane] = surface.normal.x;
    packet.hit.Ng_y[lane] = surface.normal.y;
    packet.hit.Ng_z[lane] = surface.normal.z;
    packet.hit.geomID[lane] = surface.mesh;
  }
}

/// Asks for the surfaces of a packet ahead of their use: they lie far apart.
void fetch_surfaces(const CasterTriangles& casters, const DepthImage& image, std::int32_t x0,
                    std::int32_t y0) {
  for (int n = 0; n < kMapPacketRays; ++n) {
    const std::uint64_t key = image.key(x0 + n % kPacketEdge, y0 + n / kPacketEdge);
    if (key != DepthImage::kNothing) __builtin_prefetch(&casters.surfaces[key_id(key)]);
  }
}

bool is_empty(const DepthImage& image, std::int32_t x0, std::int32_t y0) {
  for (std::int32_t y = y0; y < y0 + kPacketEdge; ++y)
    for (std::int32_t x = x0; x < x0 + kPacketEdge; ++x)
      if (image.key(x, y) != DepthImage::kNothing) return false;
  return true;
}

}  // namespace

void enter_casters(const CasterTriangles& casters, const SampleShift& shift,
                   std::span<const std::uint32_t> left_out, const PacketMask& mask, DepthImage& image) {
  HiddenChunks hidden;
  hidden.reset(image, mask);
  for (std::uint32_t chunk = 0; chunk < casters.bounds.size(); ++chunk) {
    const CasterTriangles::Bounds& bounds = casters.bounds[chunk];
    const bool enters =
        chunk < casters.front_chunks ? hidden.is_wanted(bounds, shift) : hidden.may_be_seen(bounds, shift);
    if (enters) enter_chunk(casters, chunk, shift, slots_of_chunk(left_out, chunk), image);
  }
}

std::uint64_t raster_sample_map(const EmbreeScene& scene, const CasterTriangles& casters, const MapGrid& grid,
                                const LightSample& sample, const MapBias& bias,
                                std::span<const std::uint32_t> left_out, const PacketMask& mask,
                                DepthImage& image, SampleMap& map, SlopeBiasStatistics& statistics) {
  SampleShift shift;
  for (std::size_t a = 0; a < 2; ++a) {
    shift.scale[a] = static_cast<float>(sample.position[a] / grid.pitch[a]);
    shift.shift[a] = static_cast<float>(sample.jitter[a] + 0.5);
  }
  const TexelRect& rect = map.rect();
  image.reset(rect);
  enter_casters(casters, shift, left_out, mask, image);
  const MapRays rays(grid, sample);
  const SurfaceBias surface_bias(scene, grid, sample, bias);
  CutoutRays cutout_rays(grid, sample);
  alignas(64) int valid[kMapPacketRays];
  std::fill(std::begin(valid), std::end(valid), -1);
  float nothing[kMapPacketRays];
  std::fill(std::begin(nothing), std::end(nothing), std::numeric_limits<float>::infinity());
  RTCRayHit16 packet;
  std::uint64_t looked_at = 0;
  for (std::int32_t y = rect.y0; y < rect.y1; y += kPacketEdge) {
    for (std::int32_t x = rect.x0; x < rect.x1; x += kPacketEdge) {
      const std::int32_t ahead = x + kFetchedAhead * kPacketEdge;
      if (ahead < rect.x1 && mask.is_wanted(ahead, y)) fetch_surfaces(casters, image, ahead, y);
      if (!mask.is_wanted(x, y)) continue;
      looked_at += kMapPacketRays;
      if (scene.cutouts() == nullptr && is_empty(image, x, y)) {
        map.set_packet(x, y, nothing);
        continue;
      }
      rays.fill(packet, x, y);
      take_hits(casters, image, x, y, packet);
      if (scene.cutouts() != nullptr) {
        cutout_rays.set_packet(x, y);
        rtcIntersect16(valid, scene.cutouts(), &cutout_rays.context, &packet);
      }
      store_packet(packet, surface_bias, 0, x, y, map, statistics);
    }
  }
  return looked_at;
}

}  // namespace pdsm
