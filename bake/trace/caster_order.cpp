// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_order.h"

#include <algorithm>
#include <utility>

namespace pdsm {
namespace {

/// Key, from the top: class, cell along a Z curve, id.
constexpr int kIdBits = 32, kCellBits = 11, kClassBits = 2;
constexpr std::uint32_t kCells = 1u << kCellBits;
enum Class : std::uint32_t { kLarge, kFront, kBack };
/// Two of them sort class and cell.
constexpr int kDigitBits = kCellBits + kClassBits / 2;
/// Edge of a cell in texels, at the least.
constexpr float kCellTexels = 2;

/// The lower bits of x, each moved to twice its place.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

void sort_by_digit(const std::vector<std::uint64_t>& from, int shift, std::vector<std::uint64_t>& to) {
  constexpr std::uint64_t kDigits = std::uint64_t{1} << kDigitBits;
  std::vector<std::uint32_t> next(kDigits, 0);
  const auto digit = [&](std::uint64_t key) {
    return static_cast<std::size_t>(key >> shift & (kDigits - 1));
  };
  for (const std::uint64_t key : from) ++next[digit(key)];
  std::uint32_t start = 0;
  for (std::uint32_t& n : next) start += std::exchange(n, start);
  for (const std::uint64_t key : from) to[next[digit(key)]++] = key;
}

}  // namespace

bool ProjectedTriangle::is_large() const {
  const auto is_wide = [](const std::array<float, 3>& at) {
    const float least = std::min(std::min(at[0], at[1]), at[2]),
                greatest = std::max(std::max(at[0], at[1]), at[2]);
    return greatest - least >= kLargeTexels;
  };
  return is_wide(g[0]) || is_wide(g[1]);
}

bool ProjectedTriangle::faces_light() const {
  const auto& [x, y] = g;
  return (x[1] - x[0]) * (y[2] - y[0]) < (x[2] - x[0]) * (y[1] - y[0]);
}

CasterOrder::CasterOrder(const MapGrid& grid) {
  // Cells reach half a map beside the map; what lies farther shares the outermost ones.
  for (std::size_t a = 0; a < 2; ++a) {
    const auto texels = static_cast<float>(grid.texels[a] * grid.ratio[a].maps_per_texel());
    first_[a] = -texels / 2;
    per_texel_[a] = 1 / std::max(kCellTexels, 2 * texels / static_cast<float>(kCells));
  }
}

std::uint32_t CasterOrder::cell(const ProjectedTriangle& triangle, std::size_t axis) const {
  const auto& corners = triangle.g[axis];
  const float centre = (corners[0] + corners[1] + corners[2]) / 3;
  return static_cast<std::uint32_t>(
      std::clamp((centre - first_[axis]) * per_texel_[axis], 0.0F, static_cast<float>(kCells - 1)));
}

std::uint64_t CasterOrder::key(const ProjectedTriangle& triangle, std::uint32_t id) const {
  const std::uint64_t kind = triangle.is_large() ? kLarge : triangle.faces_light() ? kFront : kBack;
  const std::uint64_t place = spread_bits(cell(triangle, 0)) | spread_bits(cell(triangle, 1)) << 1;
  return (kind << 2 * kCellBits | place) << kIdBits | id;
}

bool CasterOrder::is_front(std::uint64_t key) {
  return key >> (kIdBits + 2 * kCellBits) < kBack;
}

void CasterOrder::sort(std::vector<std::uint64_t>& keys) {
  std::vector<std::uint64_t> room(keys.size());
  sort_by_digit(keys, kIdBits, room);
  sort_by_digit(room, kIdBits + kDigitBits, keys);
}

}  // namespace pdsm
