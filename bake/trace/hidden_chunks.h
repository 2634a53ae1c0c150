// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trace/caster_triangles.h"
#include "trace/sample_map.h"
#include "trace/triangle_kernel.h"

namespace pdsm {

/// Which chunks of triangles can't change what is looked at of a depth image: those over packets that are not
/// wanted, and those behind all that was entered. Exact: the image of the wanted packets is the same with
/// and without such chunks.
class HiddenChunks {
 public:
  /// Borrows its arguments, whose rectangles are alike, until the next reset.
  void reset(const DepthImage& image, const PacketMask& mask);

  /// Whether any packet that `bounds` touch, moved by `shift`, is wanted.
  [[nodiscard]] bool is_wanted(const CasterTriangles::Bounds& bounds, const SampleShift& shift) const;
  /// Whether such a packet is not yet covered by nearer triangles. What was entered between two calls may or
  /// may not count.
  [[nodiscard]] bool may_be_seen(const CasterTriangles::Bounds& bounds, const SampleShift& shift);

 private:
  /// The greatest order of a packet's keys, or of what they were before.
  [[nodiscard]] std::uint32_t farthest(std::int32_t x, std::int32_t y);

  const DepthImage* image_ = nullptr;
  const PacketMask* mask_ = nullptr;
  std::int32_t across_ = 0;
  std::vector<std::uint32_t> farthest_;  // by packet; 0: not known, which is no depth's order
};

}  // namespace pdsm
