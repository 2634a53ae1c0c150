// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/sample_map.h"

namespace pdsm {

/// A translucent surface in a map texel: up to `depth`, what is before it lets through; behind it, `behind`
/// of a bake's transmittance units.
struct Layer {
  float depth = 0;
  std::uint32_t behind = 0;

  friend bool operator==(const Layer&, const Layer&) = default;
};

/// A surface that a ray has met, with its biased depth.
struct MetSurface {
  float depth = 0;
  double opacity = 0;
};

/// Appends the layers of `surfaces`, which are sorted by depth: the product of their transmittances in
/// double, rounded to 1 / `unit` behind each. What changes nothing is left out; surfaces at one depth make
/// one layer. Those from `end` on are left out, too.
void append_layers(std::span<const MetSurface> surfaces, float end, std::uint32_t unit,
                   std::vector<Layer>& layers);

/// What lies before the opaque casters of one sample's map: the layers of each texel, near to far.
class LayerMap {
 public:
  /// No texel of `rect` (whole packets) has layers yet.
  void reset(const TexelRect& rect);
  /// Gives layers to the next texel, row by row, of the packet whose lower corner is (x, y).
  void begin_packet(std::int32_t x, std::int32_t y);
  void append(std::span<const MetSurface> surfaces, float end, std::uint32_t unit);

  [[nodiscard]] std::span<const Layer> at(std::int64_t x, std::int64_t y) const;
  /// Whether a texel of `texels`, within the rectangle, may have layers.
  [[nodiscard]] bool any_within(const TexelRect& texels) const;

 private:
  static constexpr std::uint32_t kNone = ~0U;
  /// Where the layers of a packet's texels begin, and where the last one's end.
  using PacketLayers = std::array<std::uint32_t, kPacketEdge * kPacketEdge + 1>;

  [[nodiscard]] std::size_t packet_at(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>((y - rect_.y0) / kPacketEdge * across_ + (x - rect_.x0) / kPacketEdge);
  }

  TexelRect rect_;
  std::int64_t across_ = 0;
  std::size_t filled_ = 0;              ///< texels of the last packet
  std::vector<std::uint32_t> packets_;  ///< index of its first layers, or kNone
  std::vector<PacketLayers> texels_;
  std::vector<Layer> layers_;
};

}  // namespace pdsm
