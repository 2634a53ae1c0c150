// SPDX-License-Identifier: Apache-2.0
#include "trace/sample_map.h"

#include <algorithm>

#include "trace/cutout_holes.h"
#include "trace/map_rays.h"

namespace pdsm {
namespace {

/// Lanes that a walk may load behind a row's last ray.
constexpr std::size_t kLoadPadding = 16;

std::int32_t floor_to(std::int32_t x, std::int32_t multiple) {
  const std::int32_t rest = x % multiple;
  return rest < 0 ? x - rest - multiple : x - rest;
}

TexelRect widen_to_packets(const TexelRect& rect, std::uint32_t interleave) {
  const auto unit = kPacketEdge * static_cast<std::int32_t>(interleave);
  return {floor_to(rect.x0, unit), floor_to(rect.y0, kPacketEdge), floor_to(rect.x1 + unit - 1, unit),
          floor_to(rect.y1 + kPacketEdge - 1, kPacketEdge)};
}

}  // namespace

void SampleMap::reset(const TexelRect& rect, std::uint32_t interleave) {
  rect_ = widen_to_packets(rect, interleave);
  interleave_ = interleave;
  plane_ = (rect_.x1 - rect_.x0) / interleave_;
  pitch_ = rect_.x1 - rect_.x0;
  depth_.resize(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rect_.y1 - rect_.y0) +
                kLoadPadding);
}

void SampleMap::set_packet(std::int64_t x, std::int64_t y, const float* depths) {
  if (interleave_ == 1) {
    for (std::int64_t row = 0; row < kPacketEdge; ++row) {
      float* to = depth_.data() + (y + row - rect_.y0) * pitch_ + (x - rect_.x0);
      std::copy_n(depths + row * kPacketEdge, kPacketEdge, to);
    }
    return;
  }
  for (std::int64_t texel = 0; texel < kMapPacketRays; ++texel) {
    set(x + texel % kPacketEdge, y + texel / kPacketEdge, depths[texel]);
  }
}

std::uint64_t SampleMap::bytes_for(const TexelRect& rect, std::uint32_t interleave) {
  const TexelRect wide = widen_to_packets(rect, interleave);
  const auto texels =
      static_cast<std::uint64_t>(wide.x1 - wide.x0) * static_cast<std::uint64_t>(wide.y1 - wide.y0);
  return (texels + kLoadPadding) * sizeof(float);
}

void PacketMask::reset(const TexelRect& rect) {
  rect_ = rect;
  across_ = (rect.x1 - rect.x0) / kPacketEdge;
  wanted_.assign(
      static_cast<std::size_t>(across_) * static_cast<std::size_t>((rect.y1 - rect.y0) / kPacketEdge), 0);
}

void PacketMask::want(const TexelRect& texels) {
  const std::int32_t x0 = (texels.x0 - rect_.x0) / kPacketEdge,
                     x1 = (texels.x1 - 1 - rect_.x0) / kPacketEdge + 1;
  const std::int32_t y0 = (texels.y0 - rect_.y0) / kPacketEdge,
                     y1 = (texels.y1 - 1 - rect_.y0) / kPacketEdge + 1;
  for (std::int32_t y = y0; y < y1; ++y) {
    std::fill_n(wanted_.begin() + static_cast<std::ptrdiff_t>(y) * across_ + x0, x1 - x0, std::uint8_t{1});
  }
}

std::uint64_t trace_sample_map(const EmbreeScene& scene, const MapGrid& grid, const LightSample& sample,
                               const MapBias& bias, const PacketMask* mask, SampleMap& map,
                               SlopeBiasStatistics& statistics) {
  const MapRays rays(grid, sample);
  const SurfaceBias surface_bias(scene, grid, sample, bias);
  alignas(64) int valid[kMapPacketRays];
  std::fill(std::begin(valid), std::end(valid), -1);
  CutoutRays cutout_rays(grid, sample);
  RTCRayHit16 packet;
  std::uint64_t traced = 0;
  const TexelRect& rect = map.rect();
  for (std::int32_t y = rect.y0; y < rect.y1; y += kPacketEdge) {
    for (std::int32_t x = rect.x0; x < rect.x1; x += kPacketEdge) {
      if (mask != nullptr && !mask->is_wanted(x, y)) continue;
      rays.fill(packet, x, y);
      cutout_rays.set_packet(x, y);
      rtcIntersect16(valid, scene.handle(), &cutout_rays.context, &packet);
      store_packet(packet, surface_bias, rays.origin_z(), x, y, map, statistics);
      traced += kMapPacketRays;
    }
  }
  return traced;
}

}  // namespace pdsm
