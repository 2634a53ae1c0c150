// SPDX-License-Identifier: Apache-2.0
// Batches of look-ups go another way than single ones, which run the shader's text. Here they are held to
// them, bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "float_points.h"
#include "pdsm/runtime/look_up.h"

namespace pdsm {
namespace {

using testing::MapShape;
using testing::Random;
using testing::random_map;
using testing::to_world;

using Point = std::array<double, 3>;

/// The number itself or one of its two neighbours.
double nudged(Random& random, double value) {
  switch (random.below(3)) {
    case 0:
      return std::nextafter(value, -INFINITY);
    case 1:
      return std::nextafter(value, INFINITY);
    default:
      return value;
  }
}

/// Depth of a vertex of one of the view's functions; far if the function has none.
double some_vertex_depth(Random& random, const PenumbraMap& map, std::uint32_t view) {
  for (const FunctionImage& image : map.images) {
    if (image.view != view || image.level != 0) continue;
    const FunctionBlock& block = image.blocks[random.below(image.blocks.size())];
    const auto texel = static_cast<std::uint32_t>(random.below(block.first.size() - 1));
    const auto function = unpack_function(map.coding, block, texel);
    if (!function.empty())
      return decode_depth(map.views[view], map.coding, function[random.below(function.size())].depth);
  }
  return map.views[view].far_depth;
}

/// Before, at and behind all that a depth can meet.
double some_depth(Random& random, const PenumbraMap& map, std::uint32_t index) {
  const View& view = map.views[index];
  switch (random.below(10)) {
    case 0:
      return nudged(random, view.near_depth);
    case 1:
      return nudged(random, view.far_depth);
    case 2:
    case 3:
    case 4:
      return nudged(random, some_vertex_depth(random, map, index));
    case 5:
      return nudged(random, 0);
    case 6:
      return random.real(-2 * view.far_depth, 3 * view.far_depth);
    default:
      return random.real(view.near_depth, view.far_depth);
  }
}

/// A position along an axis of `size` texels, as a share of it: on borders of texels, at their centres, on
/// the window's border, within and around.
double some_share(Random& random, std::uint32_t size) {
  switch (random.below(6)) {
    case 0:
      return static_cast<double>(random.below(std::uint64_t{size} + 1)) / size;
    case 1:
      return (static_cast<double>(random.below(size)) + 0.5) / size;
    case 2:
      return random.real(-0.1, 1.1);
    case 3:
      return random.chance(0.5) ? 1 : 0;
    default:
      return random.real(0, 1);
  }
}

/// Numbers that computing breaks on.
double some_extreme(Random& random) {
  using Limits = std::numeric_limits<double>;
  const double extremes[] = {Limits::quiet_NaN(),
                             Limits::infinity(),
                             Limits::max(),
                             Limits::min(),
                             Limits::denorm_min(),
                             0.0,
                             1e300};
  return extremes[random.below(std::size(extremes))] * (random.chance(0.5) ? 1 : -1);
}

Point some_point(Random& random, const PenumbraMap& map) {
  const auto index = static_cast<std::uint32_t>(random.below(map.views.size()));
  const View& view = map.views[index];
  const double z = some_depth(random, map, index);
  const double reach = view.projection == Projection::perspective ? z : 1;
  const double x = view.window[0] + some_share(random, view.width) * (view.window[2] - view.window[0]);
  const double y = view.window[1] + some_share(random, view.height) * (view.window[3] - view.window[1]);
  Point p = to_world(view, {nudged(random, x * reach), nudged(random, y * reach), z});
  if (random.chance(0.02)) p[random.below(3)] = some_extreme(random);
  return p;
}

std::vector<Point> some_points(Random& random, const PenumbraMap& map, std::size_t count) {
  std::vector<Point> points(count);
  for (Point& p : points) p = some_point(random, map);
  return points;
}

void expect_same_bits(const PenumbraMap& map, const std::vector<Point>& points) {
  const PenumbraLookUp look_up(map);
  std::vector<float> values(points.size(), -1);
  std::vector<std::array<float, 3>> colours(points.size());
  for (Filter filter : {Filter::nearest, Filter::bilinear}) {
    look_up.attenuations(points, filter, values);
    look_up.attenuations(points, filter, colours);
    for (std::size_t n = 0; n < points.size(); ++n) {
      const LookUpResult result = look_up.at(points[n], filter);
      ASSERT_EQ(colours[n], result.rgb) << n;
      const float expected = result.attenuation;
      ASSERT_EQ(std::bit_cast<std::uint32_t>(values[n]), std::bit_cast<std::uint32_t>(expected))
          << (filter == Filter::bilinear ? "bilinear" : "nearest") << ", point " << n << ": " << points[n][0]
          << " " << points[n][1] << " " << points[n][2] << "; " << values[n] << " for " << expected;
    }
  }
}

/// Several blocks of 64 x 64 texels, cut at both borders; functions of one vertex beside ones of many.
MapShape shape_of_blocks(const VertexCoding& coding, Projection projection) {
  MapShape shape;
  shape.coding = coding;
  shape.projection = projection;
  shape.width = 150;
  shape.height = 70;
  shape.most_vertices = 40;
  return shape;
}

/// Where views aren't turned, points meet borders and vertices to the last bit.
void turn_to_world_axes(PenumbraMap& map) {
  for (View& view : map.views) view.world_to_view = {};
}

TEST(BatchLookUp, HasTheBitsOfSingleLookUpsForEveryCoding) {
  constexpr std::size_t kPoints = 20'000;
  std::uint64_t seed = 900;
  for (const VertexCoding& coding : testing::all_codings()) {
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
      for (bool is_turned : {false, true}) {
        SCOPED_TRACE(testing::name_of(coding));
        PenumbraMap map = random_map(++seed, shape_of_blocks(coding, projection));
        if (!is_turned) turn_to_world_axes(map);
        Random random(seed);
        expect_same_bits(map, some_points(random, map, kPoints));
      }
    }
  }
}

TEST(BatchLookUp, HasThemForViewsThatOverlapForLayersAndChannels) {
  constexpr std::size_t kPoints = 50'000;
  std::uint64_t seed = 300;
  for (LayerRule rule : {LayerRule::maximum, LayerRule::clamped_sum}) {
    for (const std::uint32_t channels : {1U, 3U})
      for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        MapShape shape = shape_of_blocks({}, projection);
        shape.views = 3;
        shape.layers = 3;
        shape.channels = channels;
        shape.levels = 2;
        PenumbraMap map = random_map(++seed, shape);
        map.layer_rule = rule;
        map.views[0].projection = Projection::perspective;
        turn_to_world_axes(map);
        Random random(seed);
        expect_same_bits(map, some_points(random, map, kPoints));
      }
  }
}

TEST(BatchLookUp, HasThemForAnyNumberOfPoints) {
  const PenumbraMap map = random_map(7);
  Random random(7);
  for (std::size_t count = 0; count < 300; ++count) expect_same_bits(map, some_points(random, map, count));
}

TEST(BatchLookUp, WritesNothingElse) {
  const PenumbraMap map = random_map(8);
  const PenumbraLookUp look_up(map);
  Random random(8);
  for (std::size_t count : {1U, 63U, 64U, 65U, 200U}) {
    std::vector<float> values(count + 1, -1);
    look_up.attenuations(some_points(random, map, count), Filter::bilinear, std::span(values).first(count));
    EXPECT_EQ(values.back(), -1);
  }
}

TEST(BatchLookUp, AnEmptyMapIsLit) {
  MapShape shape;
  shape.empty_share = 1;
  const PenumbraMap map = random_map(9, shape);
  Random random(9);
  const auto points = some_points(random, map, 1000);
  std::vector<float> values(points.size(), -1);
  PenumbraLookUp(map).attenuations(points, Filter::bilinear, values);
  for (float value : values) EXPECT_EQ(value, 0);
}

/// A map of one texel whose function steps at the least and the greatest code, and of points on all sides.
TEST(BatchLookUp, HasThemAtTheFirstAndTheLastCode) {
  for (const VertexCoding& coding : testing::all_codings()) {
    SCOPED_TRACE(testing::name_of(coding));
    const std::uint32_t last = coding.depth_max(), most = coding.value_max;
    const std::vector<FunctionVertex> functions[] = {{{0, most, most}},
                                                     {{last, most, most}},
                                                     {{0, 0, most}, {last, most, most}},
                                                     {{last - 1, most, 0}, {last, most, most}}};
    for (const auto& function : functions) {
      MapShape shape;
      shape.coding = coding;
      shape.width = shape.height = 1;
      PenumbraMap map = random_map(10, shape);
      turn_to_world_axes(map);
      map.images[0].blocks[0] = testing::make_block(coding, {function});
      Random random(10);
      expect_same_bits(map, some_points(random, map, 500));
    }
  }
}

}  // namespace
}  // namespace pdsm
