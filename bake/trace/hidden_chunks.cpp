// SPDX-License-Identifier: Apache-2.0
#include "trace/hidden_chunks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// The texels of `rect` whose centres a chunk's triangles may cover. Each step is the kernel's own, and
/// rounding keeps order, so that no corner lies outside.
TexelRect touched_texels(const CasterTriangles::Bounds& bounds, const SampleShift& shift,
                         const TexelRect& rect) {
  const std::int32_t first[2] = {rect.x0, rect.y0}, last[2] = {rect.x1, rect.y1};
  std::int32_t low[2], high[2];
  for (std::size_t a = 0; a < 2; ++a) {
    const auto [less, more] =
        std::minmax({shift.scale[a] * bounds.least_k, shift.scale[a] * bounds.greatest_k});
    const auto texel = [&](float at) {
      return static_cast<std::int32_t>(
          std::clamp(at, static_cast<float>(first[a]) - 1, static_cast<float>(last[a])));
    };
    low[a] = std::max(texel(std::ceil(bounds.least[a] + less - shift.shift[a])), first[a]);
    high[a] = std::min(texel(std::floor(bounds.greatest[a] + more - shift.shift[a])) + 1, last[a]);
  }
  return {low[0], low[1], high[0], high[1]};
}

std::int32_t packet_start(std::int32_t x, std::int32_t first) {
  return x - (x - first) % kPacketEdge;
}

/// Whether a wanted packet that touches `texels` is one of which pred(x, y) holds.
template <typename Pred>
bool any_wanted(const TexelRect& texels, const PacketMask& mask, const TexelRect& rect, Pred&& pred) {
  for (std::int32_t y = packet_start(texels.y0, rect.y0); y < texels.y1; y += kPacketEdge)
    for (std::int32_t x = packet_start(texels.x0, rect.x0); x < texels.x1; x += kPacketEdge)
      if (mask.is_wanted(x, y) && pred(x, y)) return true;
  return false;
}

}  // namespace

void HiddenChunks::reset(const DepthImage& image, const PacketMask& mask) {
  image_ = &image;
  mask_ = &mask;
  across_ = image.pitch / kPacketEdge;
  farthest_.assign(image.rect.area() / (kPacketEdge * kPacketEdge), 0);
}

bool HiddenChunks::is_wanted(const CasterTriangles::Bounds& bounds, const SampleShift& shift) const {
  const TexelRect texels = touched_texels(bounds, shift, image_->rect);
  return any_wanted(texels, *mask_, image_->rect, [](std::int32_t, std::int32_t) { return true; });
}

bool HiddenChunks::may_be_seen(const CasterTriangles::Bounds& bounds, const SampleShift& shift) {
  const TexelRect texels = touched_texels(bounds, shift, image_->rect);
  // Both zeroes, and what the kernel may flush to them, count as the nearest of these.
  constexpr float kTiny = std::numeric_limits<float>::min();
  const std::uint32_t nearest = depth_order(std::abs(bounds.least_k) < kTiny ? -kTiny : bounds.least_k);
  // An equal depth may still win by its id.
  return any_wanted(texels, *mask_, image_->rect,
                    [&](std::int32_t x, std::int32_t y) { return nearest <= farthest(x, y); });
}

std::uint32_t HiddenChunks::farthest(std::int32_t x, std::int32_t y) {
  std::uint32_t& known = farthest_[static_cast<std::size_t>((y - image_->rect.y0) / kPacketEdge * across_ +
                                                            (x - image_->rect.x0) / kPacketEdge)];
  if (known != 0) return known;
  std::uint64_t greatest = 0;
  for (std::int32_t row = y; row < y + kPacketEdge; ++row)
    for (std::int32_t column = x; column < x + kPacketEdge; ++column)
      greatest = std::max(greatest, image_->key(column, row));
  return known = static_cast<std::uint32_t>(greatest >> 32);
}

}  // namespace pdsm
