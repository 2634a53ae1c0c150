// SPDX-License-Identifier: Apache-2.0
// Million look-ups a second on one core, one at a time and many at once, at
//   random   points anywhere in the map's window and between near and far, in no order
//   surface  the last surface on each ray (where a function's domain ends), in the rows of a raster that is
//            turned against the map's
// All cases run in turn, once a round; each figure is the median over all rounds, of the thread's processor
// time. `ratio` is the median of each round's own, many at once over one at a time. usage: bench_look_up MAP
// [ROUNDS]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "count_argument.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

namespace {

using namespace pdsm;

using Points = std::vector<std::array<double, 3>>;

/// Points along an edge of the raster; of the random ones there are as many as in it.
constexpr int kEdge = 512;

/// World space of a point at shares of the window.
std::array<double, 3> world_point(const View& view, double share_x, double share_y, double z) {
  const double reach = view.projection == Projection::perspective ? z : 1;
  const auto& r = view.world_to_view.rotation;
  const auto& t = view.world_to_view.translation;
  const double q[3] = {(view.window[0] + share_x * (view.window[2] - view.window[0])) * reach - t[0],
                       (view.window[1] + share_y * (view.window[3] - view.window[1])) * reach - t[1],
                       z - t[2]};
  std::array<double, 3> p{};
  for (std::size_t a = 0; a < 3; ++a) p[a] = r[a] * q[0] + r[3 + a] * q[1] + r[6 + a] * q[2];
  return p;
}

Points random_points(const PenumbraMap& map) {
  const View& view = map.views.front();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share, depth(view.near_depth, view.far_depth);
  Points points(kEdge * kEdge);
  for (auto& point : points) point = world_point(view, share(random), share(random), depth(random));
  return points;
}

/// Depth at which the domain of a texel's function ends.
double surface_depth(const PenumbraMap& map, std::uint32_t x, std::uint32_t y) {
  const FunctionImage& image = map.images.front();
  const std::uint32_t bx = x / kBlockSize, by = y / kBlockSize;
  const FunctionBlock& block = image.blocks[by * image.blocks_across() + bx];
  const std::uint32_t width = block_extent(image.width, image.height, bx, by)[0];
  const std::uint32_t texel = y % kBlockSize * width + x % kBlockSize;
  return decode_depth(map.views.front(), map.coding,
                      block.domain_end.empty() ? map.coding.depth_max() : block.domain_end[texel]);
}

Points surface_points(const PenumbraMap& map) {
  constexpr double kTurn = 0.3;    // radians
  constexpr double kExtent = 0.8;  // of the window: no corner of the raster leaves it
  const View& view = map.views.front();
  const double step = depth_step(view, map.coding);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share;
  Points points;
  for (int j = 0; j < kEdge; ++j) {
    for (int i = 0; i < kEdge; ++i) {
      const double a = kExtent * ((i + 0.5) / kEdge - 0.5), b = kExtent * ((j + 0.5) / kEdge - 0.5);
      const double x = 0.5 + std::cos(kTurn) * a - std::sin(kTurn) * b,
                   y = 0.5 + std::sin(kTurn) * a + std::cos(kTurn) * b;
      // A domain's end is rounded up to a code.
      const double z = surface_depth(map, static_cast<std::uint32_t>(x * view.width),
                                     static_cast<std::uint32_t>(y * view.height)) -
                       step * share(random);
      points.push_back(world_point(view, x, y, z));
    }
  }
  return points;
}

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Points and a filter, looked up both ways.
struct Case {
  const char* name;
  const Points& points;
  Filter filter;
  std::vector<double> single, batched, ratio;  ///< of each round; million a second

  void run(const PenumbraLookUp& look_up) {
    std::vector<float> one_by_one(points.size()), together(points.size());
    const double begin = thread_seconds();
    for (std::size_t n = 0; n < points.size(); ++n) one_by_one[n] = look_up.at(points[n], filter).attenuation;
    const double middle = thread_seconds();
    look_up.attenuations(points, filter, together);
    const double end = thread_seconds();
    if (one_by_one != together) {
      fmt::print(stderr, "{}: the two ways differ\n", name);
      std::exit(1);
    }
    single.push_back(1e-6 * static_cast<double>(points.size()) / (middle - begin));
    batched.push_back(1e-6 * static_cast<double>(points.size()) / (end - middle));
    ratio.push_back(batched.back() / single.back());
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    fmt::print(stderr, "usage: bench_look_up MAP [ROUNDS]\n");
    return 2;
  }
  try {
    const std::uint32_t rounds = bench::count_argument(argc, argv, 2, 15);
    const PenumbraMap map = read_map(argv[1]);
    const PenumbraLookUp look_up(map);
    const Points random = random_points(map), surface = surface_points(map);
    Case cases[] = {{"random nearest", random, Filter::nearest, {}, {}, {}},
                    {"random bilinear", random, Filter::bilinear, {}, {}, {}},
                    {"surface nearest", surface, Filter::nearest, {}, {}, {}},
                    {"surface bilinear", surface, Filter::bilinear, {}, {}, {}}};
    for (std::uint32_t round = 0; round < rounds; ++round)
      for (Case& c : cases) c.run(look_up);
    fmt::print("points,one_at_a_time,many_at_once,ratio\n");
    for (const Case& c : cases)
      fmt::print("{},{:.1f},{:.1f},{:.2f}\n", c.name, median(c.single), median(c.batched), median(c.ratio));
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.failure());
  }
}
