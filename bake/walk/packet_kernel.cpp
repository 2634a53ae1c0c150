// SPDX-License-Identifier: Apache-2.0
// Compiled once for each SIMD target, by Highway's re-inclusion; the best is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/packet_kernel.cpp"
#include "hwy/foreach_target.h"  // must come before highway.h

#include "hwy/highway.h"
#include "walk/packet_kernel.h"
#include "walk/shift_walk.h"

HWY_BEFORE_NAMESPACE();
namespace pdsm::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, RayPacket::kLanes>;
constexpr std::size_t kVectorLanes = hn::MaxLanes(FloatTag());

/// One bit a lane: a < b.
HWY_INLINE std::uint32_t less_bits(hn::Vec<FloatTag> a, hn::Vec<FloatTag> b) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(FloatTag(), hn::Lt(a, b), bits);
  return static_cast<std::uint32_t>(bits[0]) | (static_cast<std::uint32_t>(bits[1]) << 8);
}

/// One bit for each of the 16 lanes: map[n] < min(end, domain_end[n]).
HWY_INLINE std::uint32_t shadow_bits(const float* map, const float* domain_end, float end) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t n = 0; n < RayPacket::kLanes; n += kVectorLanes) {
    const auto limit = hn::Min(hn::Set(d, end), hn::LoadU(d, domain_end + n));
    bits |= less_bits(hn::LoadU(d, map + n), limit) << n;
  }
  return bits;
}

/// One bit a lane: value < values[n].
HWY_INLINE std::uint32_t above_bits(float value, const float* values) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t n = 0; n < RayPacket::kLanes; n += kVectorLanes) {
    bits |= less_bits(hn::Set(d, value), hn::LoadU(d, values + n)) << n;
  }
  return bits;
}

/// Appends the events of the lanes in `changed`, whose texel of the walk begins at `begin`.
void append_events(std::uint32_t changed, std::uint32_t shadow, std::uint32_t blocked, float begin,
                   const float* map, const RayPacket& packet, EventLog& log) {
  PackedEvent* const first = log.reserve(2 * RayPacket::kLanes);
  PackedEvent* next = first;
  for (std::uint32_t rest = changed; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(rest));
    const std::uint32_t texel = packet.texel[lane];
    if ((blocked >> lane & 1) != 0) *next++ = pack_event(texel, begin, true);
    if ((shadow >> lane & 1) != 0) *next++ = pack_event(texel, std::max(map[lane], begin), false);
  }
  log.commit(static_cast<std::size_t>(next - first));
}

/// The state machine of one packet: a lane is in shadow within a texel of the walk from max(map, begin) on
/// if map < end. Lanes whose domain has ended see nothing any more.
void walk_packet(const StepTable& steps, const float* map, const RayPacket& packet, EventLog& log) {
  std::uint32_t blocked = 0;
  const std::size_t count = steps.offset.size();
  for (std::size_t n = 0; n < count; ++n) {
    const float begin = steps.begin[n];
    if (begin >= packet.last_end) return;
    const float* texels = map + steps.offset[n];
    const std::uint32_t shadow = shadow_bits(texels, packet.domain_end.data(), steps.end[n]);
    if ((shadow | blocked) == 0) continue;
    // A change, or a new occluder within the texel of a ray that was in shadow before.
    std::uint32_t changed = (shadow ^ blocked) | (shadow & blocked & above_bits(begin, texels));
    if (begin >= packet.first_end) changed &= above_bits(begin, packet.domain_end.data());
    if (changed != 0) append_events(changed, shadow, blocked, begin, texels, packet, log);
    blocked = shadow;
  }
}

void walk_packets(const StepTable& steps, const float* map, std::int64_t row_pitch,
                  std::span<const RayPacket> packets, EventLog& log) {
  for (const RayPacket& packet : packets) {
    walk_packet(steps, map + packet.row * row_pitch + packet.column, packet, log);
  }
}

}  // namespace pdsm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pdsm {

HWY_EXPORT(walk_packets);

void walk_ray_packets(const StepTable& steps, const float* map, std::int64_t row_pitch,
                      std::span<const RayPacket> packets, EventLog& log) {
  HWY_DYNAMIC_DISPATCH(walk_packets)(steps, map, row_pitch, packets, log);
}

}  // namespace pdsm
#endif
