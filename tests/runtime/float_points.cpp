// SPDX-License-Identifier: Apache-2.0
#include "float_points.h"

#include <algorithm>
#include <cmath>

namespace pdsm::testing {
namespace {

using Point = std::array<double, 3>;

Point to_view(const View& view, const Point& p) {
  const auto& r = view.world_to_view.rotation;
  const auto& t = view.world_to_view.translation;
  Point q{};
  for (std::size_t a = 0; a < 3; ++a)
    q[a] = r[3 * a] * p[0] + r[3 * a + 1] * p[1] + r[3 * a + 2] * p[2] + t[a];
  return q;
}

/// Depth of some vertex of the view's functions, or far.
double vertex_depth(Random& random, const PenumbraMap& map, std::uint32_t view) {
  const FunctionImage& image = *std::find_if(map.images.begin(), map.images.end(),
                                             [&](const FunctionImage& i) { return i.view == view; });
  const FunctionBlock& block = image.blocks[random.below(image.blocks.size())];
  const std::uint32_t words = map.coding.words_per_vertex();
  const std::size_t count = block.words.size() / words;
  if (count == 0) return map.views[view].far_depth;
  const FunctionVertex vertex = unpack_vertex(map.coding, block.words.data() + random.below(count) * words);
  return decode_depth(map.views[view], map.coding, vertex.depth);
}

double pick_depth(Random& random, const PenumbraMap& map, std::uint32_t view) {
  const double near = map.views[view].near_depth, far = map.views[view].far_depth;
  switch (random.below(8)) {
    case 0:
      return vertex_depth(random, map, view);
    case 1:
      return near;
    case 2:
      return far;
    default:
      return random.real(near - 0.1 * (far - near), far + 0.2 * (far - near));
  }
}

/// A share of the window's extent: mostly within, at times on its border or outside.
double pick_share(Random& random) {
  switch (random.below(10)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return random.real(-0.1, 1.1);
    default:
      return random.real(0, 1);
  }
}

double ulp(double magnitude) {
  const auto value = static_cast<float>(magnitude);
  return static_cast<double>(std::nextafter(value, INFINITY)) - static_cast<double>(value);
}

/// The largest coordinate that appears when the point goes into the views.
double largest_coordinate(const PenumbraMap& map, const Point& p) {
  double largest = 0;
  for (const View& view : map.views) {
    const Point q = to_view(view, p);
    for (std::size_t a = 0; a < 3; ++a)
      largest =
          std::max({largest, std::abs(p[a]), std::abs(q[a]), std::abs(view.world_to_view.translation[a])});
  }
  return largest;
}

}  // namespace

Point to_world(const View& view, const Point& p) {
  const auto& r = view.world_to_view.rotation;
  const auto& t = view.world_to_view.translation;
  const Point q{p[0] - t[0], p[1] - t[1], p[2] - t[2]};
  return {r[0] * q[0] + r[3] * q[1] + r[6] * q[2], r[1] * q[0] + r[4] * q[1] + r[7] * q[2],
          r[2] * q[0] + r[5] * q[1] + r[8] * q[2]};
}

std::vector<FloatPoint> points_to_try(Random& random, const PenumbraMap& map, std::size_t count) {
  std::vector<FloatPoint> points;
  for (std::size_t n = 0; n < count; ++n) {
    const auto index = static_cast<std::uint32_t>(random.below(map.views.size()));
    const View& view = map.views[index];
    const double z = pick_depth(random, map, index);
    const double reach = view.projection == Projection::perspective ? z : 1;
    const double x = view.window[0] + pick_share(random) * (view.window[2] - view.window[0]);
    const double y = view.window[1] + pick_share(random) * (view.window[3] - view.window[1]);
    const Point world = to_world(view, {x * reach, y * reach, z});
    points.push_back(
        {static_cast<float>(world[0]), static_cast<float>(world[1]), static_cast<float>(world[2])});
  }
  return points;
}

bool may_say(float value, const PenumbraMap& map, const PenumbraLookUp& look_up, const FloatPoint& point,
             Filter filter, double footprint) {
  const Point centre{point[0], point[1], point[2]};
  const double step = 4 * ulp(largest_coordinate(map, centre));
  // A mip level, up to 6, is good to 3 ulp by GLSL's rules; where it is blended, so is the share of each
  // level.
  const float level_rounding = footprint > 0 ? 3 * 0x1p-21F : 0;
  const float slack = std::max(1 / static_cast<float>(map.coding.value_max), 0x1p-22F) + level_rounding;
  float low = 1 + slack, high = -slack;
  const auto widen = [&](double x, double y, double z) {
    const float found =
        look_up.at({centre[0] + x * step, centre[1] + y * step, centre[2] + z * step}, filter, footprint)
            .attenuation;
    low = std::min(low, found - slack);
    high = std::max(high, found + slack);
    return value >= low && value <= high;
  };
  for (int n = 0; n < 27; ++n)
    if (widen(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) return true;
  // A border and a jump at once may leave but a sliver of the box with the value.
  constexpr int kSearch = 20'000;
  Random random(1);
  for (int n = 0; n < kSearch; ++n)
    if (widen(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1))) return true;
  return false;
}

}  // namespace pdsm::testing
