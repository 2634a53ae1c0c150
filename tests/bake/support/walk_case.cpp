// SPDX-License-Identifier: Apache-2.0
#include "support/walk_case.h"

#include <algorithm>
#include <limits>

#include "walk/walk_steps.h"

namespace pdsm::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

GridRatio random_ratio(Random& random) {
  if (random.chance(0.35)) return {random.count(1, 4), 1};
  return random.chance(0.5) ? GridRatio{1, random.count(2, 4)} : GridRatio{1, 1};
}

float random_depth(Random& random, const WalkCase& c, const std::vector<float>& borders) {
  if (random.chance(0.3)) return kInfinity;
  if (random.chance(0.3)) return random.pick_from(borders);
  // A little before near and behind far, too: shadow that is there already, shadow that never shows.
  return static_cast<float>(random.uniform(0.9 * c.grid.near_depth, 1.05 * c.grid.far_depth));
}

}  // namespace

MapGrid random_grid(Random& random, SamplePlane plane) {
  MapGrid grid;
  grid.texels = {random.count(1, 70), random.count(1, 9)};
  grid.ratio = {random_ratio(random), random_ratio(random)};
  grid.near_depth = random.pick({0.5, 1.0, 7.8});
  grid.far_depth = grid.near_depth * random.pick({1.01, 2.0, 10.0});
  grid.focus_depth = 2 / (1 / grid.near_depth + 1 / grid.far_depth);
  if (plane == SamplePlane::distant) {
    grid.projection = Projection::orthographic;
    grid.focus_depth = (grid.near_depth + grid.far_depth) / 2;
  }
  for (std::size_t a = 0; a < 2; ++a) {
    const double low = random.pick({-1.0, -0.3, 0.25}), size = random.uniform(0.05, 2);
    grid.origin[a] = low;
    grid.pitch[a] = size / grid.texels[a] / grid.ratio[a].maps_per_texel();
  }
  return grid;
}

LightSample random_sample(Random& random, const MapGrid& grid, SamplePlane plane) {
  LightSample sample;
  // The walk is |s| (1/near - 1/far) / pitch texels long, |d| (far - near) / pitch under a distant light: up
  // to about 40.
  const double unit = plane == SamplePlane::distant ? 1 / (grid.far_depth - grid.near_depth)
                                                    : 1 / (1 / grid.near_depth - 1 / grid.far_depth);
  const double length = random.pick({0.0, 0.3, 3.0, 40.0}) * random.uniform(0.5, 1);
  const double sign_x = random.pick({-1.0, 1.0}), sign_y = random.pick({-1.0, 1.0});
  const int direction = static_cast<int>(random.integer(0, 3));
  const double x = direction == 1 ? 0 : direction == 3 ? random.uniform() : 1;
  const double y = direction == 0 ? 0 : direction == 3 ? random.uniform() : 1;
  sample.position = {sign_x * x * length * unit * grid.pitch[0], sign_y * y * length * unit * grid.pitch[1],
                     0};
  if (plane == SamplePlane::distant) sample.position[2] = 1;
  if (plane == SamplePlane::tilted) sample.position[2] = random.uniform(-0.6, 0.6) * grid.near_depth;
  for (float& jitter : sample.jitter) {
    const float any = static_cast<float>(random.uniform(-0.5, 0.4999));
    jitter = random.pick({0.0F, -0.5F, 0.25F, any, any, any});
  }
  return sample;
}

WalkCase random_walk_case(Random& random, SamplePlane plane) {
  WalkCase c;
  c.grid = random_grid(random, plane);
  c.sample = random_sample(random, c.grid, plane);
  const auto width = static_cast<std::int32_t>(c.grid.texels[0]),
             height = static_cast<std::int32_t>(c.grid.texels[1]);
  c.rect.x0 = static_cast<std::int32_t>(random.integer(0, width - 1));
  c.rect.y0 = static_cast<std::int32_t>(random.integer(0, height - 1));
  if (random.chance(0.5)) c.rect.x0 = c.rect.y0 = 0;
  c.rect.x1 = static_cast<std::int32_t>(random.integer(c.rect.x0 + 1, std::min(width, c.rect.x0 + 64)));
  c.rect.y1 = static_cast<std::int32_t>(random.integer(c.rect.y0 + 1, height));
  c.domain_ends.assign(texel_count(c.rect), kInfinity);
  return c;
}

std::vector<float> border_depths(const WalkCase& c, Walk walk) {
  std::vector<float> depths;
  std::vector<WalkStep> steps;
  for (const std::int32_t j : {c.rect.y0, c.rect.y1 - 1}) {
    for (const std::int32_t i : {c.rect.x0, c.rect.x1 - 1}) {
      list_walk_steps(
          make_ray_path(c.grid, c.sample, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)), walk,
          steps);
      for (const WalkStep& step : steps) depths.insert(depths.end(), {step.begin, step.end});
    }
  }
  return depths;
}

void fill_randomly(Random& random, const WalkCase& c, const std::vector<float>& borders, SampleMap& map) {
  const TexelRect& rect = map.rect();
  const std::int64_t plateau = random.integer(1, 4);
  for (std::int64_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int64_t x = rect.x0; x < rect.x1; ++x) {
      const bool copy = x > rect.x0 && (x - rect.x0) % plateau != 0;
      map.set(x, y, copy ? map.at(x - 1, y) : random_depth(random, c, borders));
    }
  }
}

void draw_domain_ends(Random& random, const std::vector<float>& borders, WalkCase& c) {
  for (float& end : c.domain_ends) {
    const auto within = static_cast<float>(random.uniform(c.grid.near_depth, c.grid.far_depth));
    end = random.pick({kInfinity, kInfinity, static_cast<float>(0.5 * c.grid.near_depth), within, within,
                       random.pick_from(borders)});
  }
}

std::vector<std::vector<DepthEvent>> events_by_texel(const EventLog& log, std::size_t texels) {
  std::vector<std::vector<DepthEvent>> events(texels);
  log.for_each([&](PackedEvent event) {
    const EventKey key = event_key(event);
    events.at(event_texel(event)).push_back({key_depth(key), key_unblocks(key) ? -1 : 1});
  });
  return events;
}

}  // namespace pdsm::test
