// SPDX-License-Identifier: Apache-2.0
#include "trace/layer_map.h"

#include <algorithm>
#include <cmath>

namespace pdsm {

void append_layers(std::span<const MetSurface> surfaces, float end, std::uint32_t unit,
                   std::vector<Layer>& layers) {
  double transmittance = 1;
  std::uint32_t before = unit;
  for (std::size_t n = 0; n < surfaces.size() && surfaces[n].depth < end; ++n) {
    transmittance *= 1 - surfaces[n].opacity;
    if (n + 1 < surfaces.size() && surfaces[n + 1].depth == surfaces[n].depth) continue;
    const auto behind = static_cast<std::uint32_t>(std::lround(unit * transmittance));
    if (behind == before) continue;
    layers.push_back({surfaces[n].depth, behind});
    before = behind;
  }
}

void LayerMap::reset(const TexelRect& rect) {
  rect_ = rect;
  across_ = (rect.x1 - rect.x0) / kPacketEdge;
  packets_.assign(
      static_cast<std::size_t>(across_) * static_cast<std::size_t>((rect.y1 - rect.y0) / kPacketEdge), kNone);
  texels_.clear();
  layers_.clear();
}

void LayerMap::begin_packet(std::int32_t x, std::int32_t y) {
  packets_[packet_at(x, y)] = static_cast<std::uint32_t>(texels_.size());
  texels_.emplace_back().fill(static_cast<std::uint32_t>(layers_.size()));
  filled_ = 0;
}

void LayerMap::append(std::span<const MetSurface> surfaces, float end, std::uint32_t unit) {
  append_layers(surfaces, end, unit, layers_);
  texels_.back()[++filled_] = static_cast<std::uint32_t>(layers_.size());
}

std::span<const Layer> LayerMap::at(std::int64_t x, std::int64_t y) const {
  const std::uint32_t packet = packets_[packet_at(x, y)];
  if (packet == kNone) return {};
  const auto texel =
      static_cast<std::size_t>((y - rect_.y0) % kPacketEdge * kPacketEdge + (x - rect_.x0) % kPacketEdge);
  const PacketLayers& first = texels_[packet];
  return std::span(layers_).subspan(first[texel], first[texel + 1] - first[texel]);
}

bool LayerMap::any_within(const TexelRect& texels) const {
  for (std::int32_t y = (texels.y0 - rect_.y0) / kPacketEdge; y <= (texels.y1 - 1 - rect_.y0) / kPacketEdge;
       ++y) {
    const auto row = packets_.begin() + y * across_;
    const auto first = row + (texels.x0 - rect_.x0) / kPacketEdge,
               last = row + (texels.x1 - 1 - rect_.x0) / kPacketEdge + 1;
    if (std::any_of(first, last, [](std::uint32_t packet) { return packet != kNone; })) return true;
  }
  return false;
}

}  // namespace pdsm
