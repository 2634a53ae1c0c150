// SPDX-License-Identifier: Apache-2.0
#include "trace/caster_volume.h"

#include <algorithm>
#include <span>
#include <utility>

namespace pdsm {
namespace {

/// Texels that maps may be wider than what their rays reach, besides whole packets of interleaved columns.
constexpr double kMapMargin = 8;

std::span<const glm::dvec3> corners_of(const CasterPolygon& polygon) {
  return {polygon.corners.data(), static_cast<std::size_t>(polygon.count)};
}

/// Where an edge is cut, the same from either end; `to_a`, `to_b`: the ends' distances, of unlike signs.
glm::dvec3 cut(glm::dvec3 a, double to_a, glm::dvec3 b, double to_b) {
  if (to_b < to_a) {
    std::swap(a, b);
    std::swap(to_a, to_b);
  }
  return a + (b - a) * (to_a / (to_a - to_b));
}

/// Leaves what lies where distance(p) >= 0.
template <typename Distance>
void cut_off(CasterPolygon& polygon, Distance&& distance) {
  const auto corners = corners_of(polygon);
  if (std::ranges::all_of(corners, [&](const glm::dvec3& p) { return distance(p) >= 0; })) return;
  CasterPolygon rest;
  const auto put = [&](const glm::dvec3& p) { rest.corners[static_cast<std::size_t>(rest.count++)] = p; };
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const glm::dvec3 &a = corners[n], &b = corners[(n + 1) % corners.size()];
    const double to_a = distance(a), to_b = distance(b);
    if (to_a >= 0) put(a);
    if ((to_a >= 0) != (to_b >= 0)) put(cut(a, to_a, b, to_b));
  }
  polygon = rest;
}

}  // namespace

/// sign G + alpha + beta k >= bound, with the chord alpha + beta k, times z.
CasterVolume::CasterVolume(const MapGrid& grid, const LightBounds& light, double first_depth)
    : first_depth_(first_depth) {
  const double most_k = 1 / grid.focus_depth, least_k = most_k - 1 / first_depth;
  const double ray_k = (1 / grid.near_depth - 1 / grid.far_depth) / 2;
  for (std::size_t a = 0; a < 2; ++a) {
    const double pitch = grid.pitch[a], texels = grid.texels[a] * grid.ratio[a].maps_per_texel();
    const double margin = kMapMargin * (1 + std::max(grid.ratio[0].fine, grid.ratio[1].fine)) +
                          std::max(-light.min[a], light.max[a]) * ray_k / pitch;
    for (const double sign : {1.0, -1.0}) {
      const auto farthest = [&](double k) {
        return std::max(sign * light.min[a] * k, sign * light.max[a] * k) / pitch;
      };
      const double beta = (farthest(most_k) - farthest(least_k)) / (most_k - least_k);
      const double alpha = farthest(most_k) - beta * most_k;
      const double bound = sign > 0 ? -margin : -(texels + margin);
      Side& side = sides_[2 * a + (sign > 0 ? 0 : 1)];
      side.normal[static_cast<int>(a)] = sign / pitch;
      side.normal.z = -sign * grid.origin[a] / pitch + alpha + beta / grid.focus_depth - bound;
      side.offset = beta;
    }
  }
}

CasterPolygon CasterVolume::clip(const std::array<glm::dvec3, 3>& triangle) const {
  CasterPolygon polygon{{triangle[0], triangle[1], triangle[2]}, 3};
  cut_off(polygon, [&](const glm::dvec3& p) { return p.z - first_depth_; });
  for (glm::dvec3& p : polygon.corners) p.z = std::max(p.z, first_depth_);
  if (misses_maps(polygon)) return {};
  for (const Side& side : sides_)
    cut_off(polygon, [&](const glm::dvec3& p) { return side.distance(p) + kGuardTexels * p.z; });
  return polygon;
}

bool CasterVolume::misses_maps(const CasterPolygon& polygon) const {
  return std::ranges::any_of(sides_, [&](const Side& side) {
    return std::ranges::all_of(corners_of(polygon),
                               [&](const glm::dvec3& p) { return side.distance(p) < 0; });
  });
}

}  // namespace pdsm
