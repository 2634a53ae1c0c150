// SPDX-License-Identifier: Apache-2.0
// Compiled once for each SIMD target, by Highway's re-inclusion; the best is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/triangle_kernel.cpp"
#include "hwy/foreach_target.h"  // must come before highway.h

#include <algorithm>
#include <bit>

#include "hwy/highway.h"
#include "trace/triangle_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace pdsm::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Float = hn::Vec<FloatTag>;
constexpr std::uint32_t kVectorLanes = hn::MaxLanes(FloatTag());
/// Triangles over so many texels along each axis, at most, are entered together, a lane each; larger ones
/// row by row.
constexpr int kSmallTexels = 3;

HWY_INLINE std::uint32_t mask_bits(hn::Mask<FloatTag> mask) {
  std::uint64_t bits = 0;  // 8 bytes at most are written
  hn::StoreMaskBits(FloatTag(), mask, reinterpret_cast<std::uint8_t*>(&bits));
  return static_cast<std::uint32_t>(bits) & ((1u << kVectorLanes) - 1);
}

/// Floats as integers of the same order.
HWY_INLINE hn::Vec<IntTag> order_bits(Float k) {
  const IntTag d;
  const auto bits = hn::BitCast(d, k);
  return hn::Xor(bits,
                 hn::Or(hn::ShiftRight<31>(bits), hn::Set(d, std::numeric_limits<std::int32_t>::min())));
}

/// Corners of triangles in a sample's map, a triangle a lane, or one triangle in all lanes.
struct Corners {
  Float x0, x1, x2, y0, y1, y2, k0, k1, k2;
};

struct Coverage {
  hn::Mask<FloatTag> covered;
  Float k;
};

/// Whether the triangles cover the points, and their k there. Edge (a, b) of one triangle is (b, a) of its
/// neighbour, and a b - b a is the exact negative of b a - a b, however it is rounded: a point is on the
/// inner side of at least one of them. No fused operations, for these would round differently.
HWY_INLINE Coverage cover(const Corners& t, Float px, Float py) {
  const FloatTag d;
  const Float x0 = hn::Sub(t.x0, px), x1 = hn::Sub(t.x1, px), x2 = hn::Sub(t.x2, px);
  const Float y0 = hn::Sub(t.y0, py), y1 = hn::Sub(t.y1, py), y2 = hn::Sub(t.y2, py);
  const Float e0 = hn::Sub(hn::Mul(x1, y2), hn::Mul(y1, x2)), e1 = hn::Sub(hn::Mul(x2, y0), hn::Mul(y2, x0)),
              e2 = hn::Sub(hn::Mul(x0, y1), hn::Mul(y0, x1));
  const Float zero = hn::Zero(d), sum = hn::Add(hn::Add(e0, e1), e2);
  const auto least = hn::Min(hn::Min(e0, e1), e2), greatest = hn::Max(hn::Max(e0, e1), e2);
  const auto covered = hn::And(hn::Or(hn::Ge(least, zero), hn::Le(greatest, zero)), hn::Ne(sum, zero));
  const Float k = hn::Div(hn::Add(hn::Add(hn::Mul(e0, t.k0), hn::Mul(e1, t.k1)), hn::Mul(e2, t.k2)), sum);
  const Float low = hn::Min(hn::Min(t.k0, t.k1), t.k2), high = hn::Max(hn::Max(t.k0, t.k1), t.k2);
  return {covered, hn::Min(hn::Max(k, low), high)};
}

HWY_INLINE void enter(std::uint64_t& key, std::int32_t order, std::uint32_t id) {
  const std::uint64_t mine = (std::uint64_t{static_cast<std::uint32_t>(order)} << 32) | id;
  key = std::min(key, mine);
}

/// Texels of a triangle's bounds, inclusive, as floats a lane.
struct Extent {
  alignas(64) float x0[kVectorLanes], x1[kVectorLanes], y0[kVectorLanes], y1[kVectorLanes];
};

/// Enters one triangle, row by row.
void enter_large(const Corners& t, const Extent& extent, std::uint32_t lane, std::uint32_t id,
                 DepthImage& image) {
  const FloatTag d;
  alignas(64) float x[9][kVectorLanes];
  const Float all[9] = {t.x0, t.x1, t.x2, t.y0, t.y1, t.y2, t.k0, t.k1, t.k2};
  for (int n = 0; n < 9; ++n) hn::Store(all[n], d, x[n]);
  const auto one = [&](int n) { return hn::Set(d, x[n][lane]); };
  const Corners corners{one(0), one(1), one(2), one(3), one(4), one(5), one(6), one(7), one(8)};
  const auto last = static_cast<std::int32_t>(extent.x1[lane]),
             y1 = static_cast<std::int32_t>(extent.y1[lane]);
  alignas(64) std::int32_t order[kVectorLanes];
  for (auto y = static_cast<std::int32_t>(extent.y0[lane]); y <= y1; ++y) {
    std::uint64_t* const row =
        image.keys.data() + static_cast<std::ptrdiff_t>(y - image.rect.y0) * image.pitch - image.rect.x0;
    const Float py = hn::Set(d, static_cast<float>(y));
    for (auto at = static_cast<std::int32_t>(extent.x0[lane]); at <= last;
         at += static_cast<std::int32_t>(kVectorLanes)) {
      const Float px = hn::Iota(d, static_cast<float>(at));
      const Coverage c = cover(corners, px, py);
      std::uint32_t bits = mask_bits(hn::And(c.covered, hn::Le(px, hn::Set(d, extent.x1[lane]))));
      if (bits == 0) continue;
      hn::Store(order_bits(c.k), IntTag(), order);
      for (; bits != 0; bits &= bits - 1) {
        const int n = std::countr_zero(bits);
        enter(row[at + n], order[n], id);
      }
    }
  }
}

/// Enters triangles at one texel each.
HWY_INLINE void enter_at(const Corners& t, Float x, Float y, std::uint32_t small, const std::uint32_t* ids,
                         DepthImage& image) {
  const Coverage c = cover(t, x, y);
  std::uint32_t bits = mask_bits(c.covered) & small;
  if (bits == 0) return;
  const IntTag d;
  alignas(64) std::int32_t order[kVectorLanes], texel[kVectorLanes];
  const auto column = hn::Sub(hn::ConvertTo(d, x), hn::Set(d, image.rect.x0));
  const auto row = hn::Sub(hn::ConvertTo(d, y), hn::Set(d, image.rect.y0));
  hn::Store(hn::Add(hn::Mul(row, hn::Set(d, image.pitch)), column), d, texel);
  hn::Store(order_bits(c.k), d, order);
  for (; bits != 0; bits &= bits - 1) {
    const auto n = static_cast<std::uint32_t>(std::countr_zero(bits));
    enter(image.keys[static_cast<std::size_t>(texel[n])], order[n], ids[n]);
  }
}

/// First and last texels of triangles' bounds, inclusive, a triangle a lane.
struct Bounds {
  Float x0, x1, y0, y1;
};

/// Enters the triangles of lanes `small`, texel by texel of their bounds, all lanes together.
HWY_INLINE void enter_small(const Corners& t, const Bounds& bounds, std::uint32_t small,
                            const std::uint32_t* ids, DepthImage& image) {
  const Float one = hn::Set(FloatTag(), 1.0F);
  Float y = bounds.y0;
  for (int row = 0; row < kSmallTexels; ++row, y = hn::Add(y, one)) {
    const std::uint32_t in_row = small & mask_bits(hn::Le(y, bounds.y1));
    if (in_row == 0) return;
    Float x = bounds.x0;
    for (int column = 0; column < kSmallTexels; ++column, x = hn::Add(x, one)) {
      const std::uint32_t here = in_row & mask_bits(hn::Le(x, bounds.x1));
      if (here == 0) break;
      enter_at(t, x, y, here, ids, image);
    }
  }
}

void enter_triangles(const CasterTriangles& casters, std::uint32_t chunk, const SampleShift& shift,
                     std::span<const std::uint32_t> left_out, DepthImage& image) {
  const FloatTag d;
  const Float scale_x = hn::Set(d, shift.scale[0]), scale_y = hn::Set(d, shift.scale[1]),
              shift_x = hn::Set(d, shift.shift[0]), shift_y = hn::Set(d, shift.shift[1]);
  const Float least_x = hn::Set(d, static_cast<float>(image.rect.x0)),
              least_y = hn::Set(d, static_cast<float>(image.rect.y0)),
              most_x = hn::Set(d, static_cast<float>(image.rect.x1 - 1)),
              most_y = hn::Set(d, static_cast<float>(image.rect.y1 - 1));
  const std::uint32_t begin = chunk * CasterTriangles::kChunk, end = begin + CasterTriangles::kChunk;
  for (std::uint32_t first = begin; first < end; first += kVectorLanes) {
    const auto load = [&](const std::vector<float>& values) { return hn::LoadU(d, values.data() + first); };
    const auto move = [](Float g, Float scale, Float k, Float by) {
      return hn::Sub(hn::Add(g, hn::Mul(scale, k)), by);
    };
    const Float k0 = load(casters.k[0]), k1 = load(casters.k[1]), k2 = load(casters.k[2]);
    const Float x0 = move(load(casters.g[0][0]), scale_x, k0, shift_x),
                x1 = move(load(casters.g[0][1]), scale_x, k1, shift_x),
                x2 = move(load(casters.g[0][2]), scale_x, k2, shift_x);
    const Float first_x = hn::Max(hn::Ceil(hn::Min(hn::Min(x0, x1), x2)), least_x),
                last_x = hn::Min(hn::Floor(hn::Max(hn::Max(x0, x1), x2)), most_x);
    const Float y0 = move(load(casters.g[1][0]), scale_y, k0, shift_y),
                y1 = move(load(casters.g[1][1]), scale_y, k1, shift_y),
                y2 = move(load(casters.g[1][2]), scale_y, k2, shift_y);
    const Float first_y = hn::Max(hn::Ceil(hn::Min(hn::Min(y0, y1), y2)), least_y),
                last_y = hn::Min(hn::Floor(hn::Max(hn::Max(y0, y1), y2)), most_y);
    const auto met = hn::And(hn::Le(first_x, last_x), hn::Le(first_y, last_y));
    std::uint32_t bits = mask_bits(met);
    for (const std::uint32_t slot : left_out)
      if (slot - first < kVectorLanes) bits &= ~(1u << (slot - first));
    if (bits == 0) continue;
    const Corners corners{x0, x1, x2, y0, y1, y2, k0, k1, k2};
    const std::uint32_t* const ids = casters.ids.data() + first;
    const Float reach = hn::Set(d, kSmallTexels - 1);
    const std::uint32_t small = bits & mask_bits(hn::And(hn::Le(hn::Sub(last_x, first_x), reach),
                                                         hn::Le(hn::Sub(last_y, first_y), reach)));
    if (small != 0) enter_small(corners, {first_x, last_x, first_y, last_y}, small, ids, image);
    if (small == bits) continue;
    Extent extent;
    hn::Store(first_x, d, extent.x0);
    hn::Store(last_x, d, extent.x1);
    hn::Store(first_y, d, extent.y0);
    hn::Store(last_y, d, extent.y1);
    for (std::uint32_t rest = bits & ~small; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(rest));
      enter_large(corners, extent, lane, ids[lane], image);
    }
  }
}

}  // namespace pdsm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pdsm {

HWY_EXPORT(enter_triangles);

void enter_chunk(const CasterTriangles& casters, std::uint32_t chunk, const SampleShift& shift,
                 std::span<const std::uint32_t> left_out, DepthImage& image) {
  HWY_DYNAMIC_DISPATCH(enter_triangles)(casters, chunk, shift, left_out, image);
}

}  // namespace pdsm
#endif
