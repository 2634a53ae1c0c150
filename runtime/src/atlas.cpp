// SPDX-License-Identifier: Apache-2.0
#include "atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pdsm {
namespace {

/// Shelves of at most `width`, the tallest rectangles first.
Atlas fill_shelves(std::span<const std::array<std::uint32_t, 2>> sizes, std::uint32_t width) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a][1] > sizes[b][1]; });
  Atlas atlas;
  atlas.corners.resize(sizes.size());
  std::uint32_t x = 0, y = 0, shelf = 0;
  for (const std::size_t n : order) {
    if (x > 0 && std::uint64_t{x} + sizes[n][0] > width) {
      y += shelf;
      x = shelf = 0;
    }
    atlas.corners[n] = {x, y};
    x += sizes[n][0];
    shelf = std::max(shelf, sizes[n][1]);
    atlas.width = std::max(atlas.width, x);
    atlas.height = y + shelf;
  }
  return atlas;
}

}  // namespace

Atlas place_rectangles(std::span<const std::array<std::uint32_t, 2>> sizes, std::uint32_t limit) {
  std::uint64_t area = 0, total = 0;
  std::uint32_t widest = 1;
  for (const auto& size : sizes) {
    area += std::uint64_t{size[0]} * size[1];
    total += size[0];
    widest = std::max(widest, size[0]);
  }
  // The squarest atlas wastes least where all are alike; as long as it is too high, a wider one may do.
  auto width =
      std::max<std::uint64_t>(widest, static_cast<std::uint64_t>(std::sqrt(static_cast<double>(area))));
  for (;;) {
    Atlas atlas = fill_shelves(sizes, static_cast<std::uint32_t>(width));
    if (atlas.height <= limit || width >= std::min<std::uint64_t>(limit, total)) return atlas;
    width = std::min<std::uint64_t>(limit, 2 * width);
  }
}

}  // namespace pdsm
