// SPDX-License-Identifier: Apache-2.0
#include "plain_bake.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "trace/sample_map.h"
#include "walk/general_walk.h"
#include "walk/ray_path.h"

namespace pdsm::bench {
namespace {

using Events = std::vector<std::pair<float, int>>;  ///< depth, +1 blocked or -1 unblocked

/// One axis of a path on its way from near to far, from border to border of texels.
struct Axis {
  Axis(const RayPath& path, std::size_t a)
      : step(path.slope[a] < 0 ? 1 : -1),
        texel(path.base[a] +
              static_cast<std::int64_t>(std::floor(path.fraction[a] + path.slope[a] * path.w_begin))),
        fraction(path.fraction[a]),
        slope(path.slope[a]),
        border(std::floor(fraction + slope * path.w_begin) + (slope < 0 ? 1 : 0)) {}

  [[nodiscard]] double next() const {
    return slope == 0 ? -std::numeric_limits<double>::infinity() : (border - fraction) / slope;
  }
  void pass() {
    border += step;
    texel += step;
  }

  int step;
  std::int64_t texel;
  double fraction, slope, border;
};

void append_events(const RayPath& path, const SampleMap& map, Events& events) {
  Axis x(path, 0), y(path, 1);
  bool in_shadow = false;
  float begin = path.depth(path.w_begin);
  for (bool more = true; more;) {
    const double w = std::max(x.next(), y.next());
    more = w > path.w_end;
    const float end = path.depth(more ? std::min(w, path.w_begin) : path.w_end);
    if (begin < end) {
      const float m = map.at(x.texel, y.texel);
      const bool shadow_here = m < end, from_begin = m <= begin;
      if (in_shadow && !from_begin) events.emplace_back(begin, -1);
      if (shadow_here && !(in_shadow && from_begin)) events.emplace_back(std::max(m, begin), +1);
      in_shadow = shadow_here;
    }
    (x.next() >= y.next() ? x : y).pass();
    begin = end;
  }
}

}  // namespace

std::uint64_t bake_plainly(const BakeJob& job) {
  const auto width = static_cast<std::int32_t>(job.grid.texels[0]),
             height = static_cast<std::int32_t>(job.grid.texels[1]);
  std::vector<Events> functions(std::size_t{job.grid.texels[0]} * job.grid.texels[1]);
  const auto threads = static_cast<int>(job.options.threads);
  std::vector<SampleMap> maps(job.samples.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const LightSample& sample = job.samples[n];
    SlopeBiasStatistics statistics;
    maps[n].reset(general_footprint(job.grid, sample, {0, 0, width, height}), job.grid.ratio[0].fine);
    trace_sample_map(*job.embree, job.grid, sample, {job.bias, {0.5, 0.5}, job.grid.far_depth}, nullptr,
                     maps[n], statistics);
  }
  for (std::size_t n = 0; n < maps.size(); ++n) {
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::int32_t j = 0; j < height; ++j) {
      for (std::int32_t i = 0; i < width; ++i)
        append_events(
            make_ray_path(job.grid, job.samples[n], static_cast<std::uint32_t>(i),
                          static_cast<std::uint32_t>(j)),
            maps[n],
            functions[static_cast<std::size_t>(j) * job.grid.texels[0] + static_cast<std::size_t>(i)]);
    }
  }
  std::uint64_t count = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads) reduction(+ : count)
  for (std::size_t n = 0; n < functions.size(); ++n) {
    std::sort(functions[n].begin(), functions[n].end());
    int blocked = 0;
    for (auto& [depth, change] : functions[n]) change = blocked += change;
    count += functions[n].size();
  }
  return count;
}

}  // namespace pdsm::bench
