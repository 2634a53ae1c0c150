// SPDX-License-Identifier: Apache-2.0
#include "tile/share_rect.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

std::int64_t blocks_of(const TexelRect& rect) {
  return static_cast<std::int64_t>(rect.x1 - rect.x0) * (rect.y1 - rect.y0);
}

/// Cuts `rect` (blocks) along its longer side, and `count` shares with it: the shares of the first half.
std::int64_t cut(const TexelRect& rect, std::int64_t count, TexelRect& first, TexelRect& second) {
  first = second = rect;
  const bool across = rect.x1 - rect.x0 >= rect.y1 - rect.y0;
  const std::int32_t length = across ? rect.x1 - rect.x0 : rect.y1 - rect.y0;
  const double place =
      static_cast<double>(length) * static_cast<double>(count / 2) / static_cast<double>(count);
  const std::int32_t at = std::clamp(static_cast<std::int32_t>(std::lround(place)), 1, length - 1);
  if (across)
    first.x1 = second.x0 = rect.x0 + at;
  else
    first.y1 = second.y0 = rect.y0 + at;
  // Neither half has to give more shares than it has blocks.
  return std::clamp(count / 2, count - std::min(count, blocks_of(second)), blocks_of(first));
}

}  // namespace

TexelRect share_rect(const MapGrid& grid, const Share& share) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  TexelRect rect{0, 0, static_cast<std::int32_t>(blocks_along(grid.texels[0])),
                 static_cast<std::int32_t>(blocks_along(grid.texels[1]))};
  if (blocks_of(rect) < share.count) {
    throw Error(Failure::usage, "--shard",
                "the map has only " + std::to_string(blocks_of(rect)) + " blocks of 64 x 64 texels to share");
  }
  for (std::int64_t index = share.index - 1, count = share.count; count > 1;) {
    TexelRect first, second;
    const std::int64_t of_first = cut(rect, count, first, second);
    const bool in_first = index < of_first;
    rect = in_first ? first : second;
    index -= in_first ? 0 : of_first;
    count = in_first ? of_first : count - of_first;
  }
  return {rect.x0 * edge, rect.y0 * edge, std::min(rect.x1 * edge, static_cast<std::int32_t>(grid.texels[0])),
          std::min(rect.y1 * edge, static_cast<std::int32_t>(grid.texels[1]))};
}

}  // namespace pdsm
