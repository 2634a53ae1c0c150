// SPDX-License-Identifier: Apache-2.0
#include "walk/general_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// The midpoint walk may pick a texel beside the path.
constexpr std::int32_t kMidpointMargin = 1;

void walk_ray(const RayPath& path, const std::vector<WalkStep>& steps, const SampleMap& map,
              std::uint32_t texel, float domain_end, EventLog& log) {
  bool blocked = false;
  for (const WalkStep& step : steps) {
    if (step.begin >= domain_end) return;
    const float depth = map.at(path.base[0] + step.dx, path.base[1] + step.dy);
    const bool shadow = depth < std::min(step.end, domain_end);
    const bool again = shadow && blocked && depth > step.begin;
    if (shadow != blocked || again) {
      PackedEvent* next = log.reserve(2);
      const PackedEvent* first = next;
      if (blocked) *next++ = pack_event(texel, step.begin, true);
      if (shadow) *next++ = pack_event(texel, std::max(depth, step.begin), false);
      log.commit(static_cast<std::size_t>(next - first));
    }
    blocked = shadow;
  }
}

/// Calls visit(path, texel within the block) for each ray of `rect` that ends behind near, with its steps
/// listed.
template <typename Visitor>
void for_each_ray(const MapGrid& grid, const LightSample& sample, Walk walk, const TexelRect& rect,
                  std::span<const float> ends, std::vector<WalkStep>& steps, Visitor&& visit) {
  std::uint32_t texel = 0;
  for (std::int32_t j = rect.y0; j < rect.y1; ++j) {
    for (std::int32_t i = rect.x0; i < rect.x1; ++i, ++texel) {
      if (!(static_cast<double>(ends[texel]) > grid.near_depth)) continue;
      const RayPath path =
          make_ray_path(grid, sample, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      list_walk_steps(path, walk, steps);
      visit(path, texel);
    }
  }
}

}  // namespace

TexelRect general_footprint(const MapGrid& grid, const LightSample& sample, const TexelRect& rays) {
  // g is linear in the ray's slope and in w, so the corner rays' ends bound it.
  constexpr auto kMost = std::numeric_limits<double>::infinity();
  double x0 = kMost, y0 = kMost, x1 = -kMost, y1 = -kMost;
  for (const std::int32_t j : {rays.y0, rays.y1 - 1}) {
    for (const std::int32_t i : {rays.x0, rays.x1 - 1}) {
      const RayPath path =
          make_ray_path(grid, sample, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      for (const double w : {path.w_begin, path.w_end}) {
        const double x = static_cast<double>(path.base[0]) + path.fraction[0] + path.slope[0] * w;
        const double y = static_cast<double>(path.base[1]) + path.fraction[1] + path.slope[1] * w;
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
      }
    }
  }
  const auto texel = [](double g) { return static_cast<std::int32_t>(std::floor(g)); };
  return {texel(x0) - kMidpointMargin, texel(y0) - kMidpointMargin, texel(x1) + 1 + kMidpointMargin,
          texel(y1) + 1 + kMidpointMargin};
}

void walk_general(const MapGrid& grid, const LightSample& sample, Walk walk, const SampleMap& map,
                  const TexelRect& rect, std::span<const float> domain_ends, std::vector<WalkStep>& steps,
                  EventLog& log) {
  for_each_ray(grid, sample, walk, rect, domain_ends, steps, [&](const RayPath& path, std::uint32_t texel) {
    walk_ray(path, steps, map, texel, domain_ends[texel], log);
  });
}

void walk_general(const MapGrid& grid, const LightSample& sample, Walk walk, const LayeredMap& map,
                  const TexelRect& rect, std::span<const float> domain_ends, std::vector<WalkStep>& steps,
                  EventLog& log) {
  for_each_ray(grid, sample, walk, rect, domain_ends, steps, [&](const RayPath& path, std::uint32_t texel) {
    walk_layers(map, steps, path.base[0], path.base[1], texel, domain_ends[texel], log);
  });
}

}  // namespace pdsm
