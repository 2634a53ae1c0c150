// SPDX-License-Identifier: Apache-2.0
// Look-ups per second on one core: one at a time and batched, nearest and bilinear.
// usage: PDSM_MAP=FILE.pdsm bench_look_up
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

namespace {

constexpr std::size_t kPoints = 1 << 16;

const pdsm::PenumbraMap& map() {
  static const pdsm::PenumbraMap loaded = [] {
    const char* path = std::getenv("PDSM_MAP");
    return pdsm::read_map(path != nullptr ? path : "map.pdsm");
  }();
  return loaded;
}

/// Points spread over the window's pyramid, in world space.
std::vector<std::array<double, 3>> spread_points() {
  const pdsm::View& view = map().views.front();
  const auto& r = view.world_to_view.rotation;
  const auto& t = view.world_to_view.translation;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<std::array<double, 3>> points(kPoints);
  for (auto& point : points) {
    const double z = view.near_depth + uniform(random) * (view.far_depth - view.near_depth);
    const double x = z * (view.window[0] + uniform(random) * (view.window[2] - view.window[0])) - t[0];
    const double y = z * (view.window[1] + uniform(random) * (view.window[3] - view.window[1])) - t[1];
    for (std::size_t a = 0; a < 3; ++a) point[a] = r[a] * x + r[3 + a] * y + r[6 + a] * (z - t[2]);
  }
  return points;
}

void single(benchmark::State& state, pdsm::Filter filter) {
  const pdsm::PenumbraLookUp look_up(map());
  const auto points = spread_points();
  for (auto _ : state) {
    for (const auto& point : points) benchmark::DoNotOptimize(look_up.at(point, filter));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}

void batched(benchmark::State& state, pdsm::Filter filter) {
  const pdsm::PenumbraLookUp look_up(map());
  const auto points = spread_points();
  std::vector<float> attenuation(points.size());
  for (auto _ : state) {
    look_up.attenuations(points, filter, attenuation);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}

BENCHMARK_CAPTURE(single, nearest, pdsm::Filter::nearest);
BENCHMARK_CAPTURE(single, bilinear, pdsm::Filter::bilinear);
BENCHMARK_CAPTURE(batched, nearest, pdsm::Filter::nearest);
BENCHMARK_CAPTURE(batched, bilinear, pdsm::Filter::bilinear);

}  // namespace

BENCHMARK_MAIN();
