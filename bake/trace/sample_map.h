// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdsm/format/penumbra_map.h"
#include "trace/embree_scene.h"
#include "trace/surface_bias.h"
#include "walk/map_grid.h"

namespace pdsm {

/// A rectangle of texels, half-open, in global coordinates of their grid.
struct TexelRect {
  std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] std::size_t area() const {
    return static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0);
  }
};

/// Blocks that this many texels along one axis lie in.
[[nodiscard]] constexpr std::uint32_t blocks_along(std::uint32_t texels) {
  return (texels + kBlockSize - 1) / kBlockSize;
}
[[nodiscard]] constexpr std::int32_t blocks_along(std::int32_t texels) {
  return static_cast<std::int32_t>(blocks_along(static_cast<std::uint32_t>(texels)));
}

/// Edge of a ray packet in map texels; packets are aligned to the global map grid.
inline constexpr std::int32_t kPacketEdge = 4;

/// Which packets of a sample map are looked at, and so have to be traced.
class PacketMask {
 public:
  /// No packet of `rect` (whole packets) is wanted yet.
  void reset(const TexelRect& rect);
  /// Wants all packets that `texels`, within the rectangle, touches.
  void want(const TexelRect& texels);
  [[nodiscard]] bool is_wanted(std::int32_t x, std::int32_t y) const {
    return wanted_[static_cast<std::size_t>((y - rect_.y0) / kPacketEdge * across_ +
                                            (x - rect_.x0) / kPacketEdge)] != 0;
  }

 private:
  TexelRect rect_;
  std::int32_t across_ = 0;
  std::vector<std::uint8_t> wanted_;
};

/// The part of one sample's shadow map that a tile needs: biased depth of the nearest occluder, +infinity
/// where there is none. Columns are stored by their remainder modulo `interleave` (the map texels per PDSM
/// texel), so that the texels under a row of neighbouring rays are neighbours in memory.
class SampleMap {
 public:
  /// Makes room for `rect`, widened to whole ray packets. Contents are undefined afterwards.
  void reset(const TexelRect& rect, std::uint32_t interleave);

  [[nodiscard]] const TexelRect& rect() const { return rect_; }
  [[nodiscard]] std::ptrdiff_t index(std::int64_t x, std::int64_t y) const {
    const std::int64_t column = x - rect_.x0;
    return static_cast<std::ptrdiff_t>((y - rect_.y0) * pitch_ + column % interleave_ * plane_ +
                                       column / interleave_);
  }
  [[nodiscard]] float at(std::int64_t x, std::int64_t y) const {
    return depth_[static_cast<std::size_t>(index(x, y))];
  }
  void set(std::int64_t x, std::int64_t y, float depth) {
    depth_[static_cast<std::size_t>(index(x, y))] = depth;
  }
  /// Stores the depths of a packet of 4 x 4 texels, row by row, whose lower corner is (x, y).
  void set_packet(std::int64_t x, std::int64_t y, const float* depths);
  [[nodiscard]] const float* data() const { return depth_.data(); }
  [[nodiscard]] std::int64_t pitch() const { return pitch_; }
  [[nodiscard]] std::int64_t plane() const { return plane_; }
  [[nodiscard]] std::int64_t interleave() const { return interleave_; }

  /// Bytes that reset(rect) takes.
  [[nodiscard]] static std::uint64_t bytes_for(const TexelRect& rect, std::uint32_t interleave);

 private:
  TexelRect rect_;
  std::int64_t interleave_ = 1, plane_ = 0, pitch_ = 0;
  std::vector<float> depth_;
};

/// Sums of the slope bias that was added, for the report.
struct SlopeBiasStatistics {
  double sum = 0;  ///< metres over all rays
  float max = 0;   ///< metres
};

/// Traces the map of `sample` into `map`, over the rectangle that it was reset to, in packets of 4 x 4
/// texels. Packets that `mask` does not want are left as they are; no mask: all are traced. Returns the
/// number of rays. Any thread; each with a map of its own.
std::uint64_t trace_sample_map(const EmbreeScene& scene, const MapGrid& grid, const LightSample& sample,
                               const MapBias& bias, const PacketMask* mask, SampleMap& map,
                               SlopeBiasStatistics& statistics);

}  // namespace pdsm
