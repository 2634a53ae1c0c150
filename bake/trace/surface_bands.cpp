// SPDX-License-Identifier: Apache-2.0
#include "trace/surface_bands.h"

#include <algorithm>
#include <cmath>

#include "trace/receiver_rays.h"

namespace pdsm {
namespace {

/// A ray goes on this share of far in front of the surface that it met.
constexpr double kStepShare = 1e-6;

using Bands = std::vector<DepthBand>;

/// How far a plane may lie behind `depth`, where a ray meets it, within a texel of that ray; at most far.
double rise_within_texel(const MapGrid& grid, const PlaneOnRay& plane, double depth) {
  const double texel_u = grid.pitch[0] * grid.ratio[0].maps_per_texel(),
               texel_v = grid.pitch[1] * grid.ratio[1].maps_per_texel();
  const double change = std::abs(plane.slope_u) * texel_u + std::abs(plane.slope_v) * texel_v;
  // Parallel rays meet a plane at depths that are linear in their place.
  if (!grid.perspective()) return change < grid.far_depth ? change : grid.far_depth;
  // As for the slope bias (surface_bias.cpp): over a texel, n . d shrinks by this share.
  const double share = change / depth;
  return std::min(share < 1 ? depth * share / (1 - share) : grid.far_depth, grid.far_depth);
}

/// Bands of all light-facing receiver surfaces on one PDSM ray, unsorted.
void collect_bands(const EmbreeScene& scene, const MapGrid& grid, double u, double v, double margin,
                   Bands& bands) {
  ReceiverContext receiver(Heading::to_light);
  const CentralRay central = grid.ray(u, v);
  double start = receiver_ray_start(grid);
  while (start > grid.near_depth) {
    const RayToLight to_light = ray_to_light(central, start);
    const glm::vec3 &from = to_light.origin, &along = to_light.direction;
    RTCRayHit ray{};
    ray.ray = {from.x,        from.y, from.z, 0, along.x, along.y, along.z, 0, static_cast<float>(start),
               kReceiverMask, 0,      0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene.handle(), &receiver.context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    const double traced = start - static_cast<double>(ray.ray.tfar);
    const PlaneOnRay plane =
        plane_on_ray(scene.geometry().meshes[ray.hit.geomID], ray.hit.primID, grid, central);
    const double depth = surface_depth(grid, plane, traced);
    const double reach = rise_within_texel(grid, plane, depth) + margin;
    bands.push_back({static_cast<float>(depth - reach), static_cast<float>(depth + reach)});
    start = traced - kStepShare * grid.far_depth;
  }
}

/// Sorts bands and joins those that overlap.
void join_bands(Bands& bands) {
  std::sort(bands.begin(), bands.end(),
            [](const DepthBand& a, const DepthBand& b) { return a.first < b.first; });
  std::size_t kept = 0;
  for (const DepthBand& band : bands) {
    if (kept > 0 && band.first <= bands[kept - 1].last)
      bands[kept - 1].last = std::max(bands[kept - 1].last, band.last);
    else
      bands[kept++] = band;
  }
  bands.resize(kept);
}

}  // namespace

std::vector<std::vector<DepthBand>> find_surface_bands(const EmbreeScene& scene, const MapGrid& grid,
                                                       const TexelRect& rect, double margin) {
  // The rays of the rectangle and of a border of one texel, clamped to the map.
  const TexelRect wide{std::max(rect.x0 - 1, 0), std::max(rect.y0 - 1, 0),
                       std::min(rect.x1 + 1, static_cast<std::int32_t>(grid.texels[0])),
                       std::min(rect.y1 + 1, static_cast<std::int32_t>(grid.texels[1]))};
  const std::int32_t width = wide.x1 - wide.x0;
  std::vector<Bands> of_ray(wide.area());
  std::size_t next = 0;
  for (std::int32_t j = wide.y0; j < wide.y1; ++j) {
    for (std::int32_t i = wide.x0; i < wide.x1; ++i) {
      collect_bands(scene, grid, grid.center_slope(0, static_cast<std::uint32_t>(i)),
                    grid.center_slope(1, static_cast<std::uint32_t>(j)), margin, of_ray[next++]);
    }
  }
  std::vector<Bands> result;
  for (std::int32_t j = rect.y0; j < rect.y1; ++j) {
    for (std::int32_t i = rect.x0; i < rect.x1; ++i) {
      Bands& bands = result.emplace_back();
      for (std::int32_t y = std::max(j - 1, wide.y0); y <= std::min(j + 1, wide.y1 - 1); ++y) {
        for (std::int32_t x = std::max(i - 1, wide.x0); x <= std::min(i + 1, wide.x1 - 1); ++x) {
          const Bands& from = of_ray[static_cast<std::size_t>((y - wide.y0) * width + x - wide.x0)];
          bands.insert(bands.end(), from.begin(), from.end());
        }
      }
      join_bands(bands);
    }
  }
  return result;
}

}  // namespace pdsm
