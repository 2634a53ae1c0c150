// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/look_up.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "float_points.h"

namespace pdsm {
namespace {

using testing::MapShape;
using testing::Random;
using testing::random_map;
using testing::to_world;

using Point = std::array<double, 3>;

/// 2 ulp of a float near 1, and the same relative to smaller values.
constexpr double kTwoUlp = 2.4e-7;

/// The image of a layer, view and channel, level 0.
const FunctionImage& base_image(const PenumbraMap& map, std::uint32_t layer, std::uint32_t view,
                                std::uint32_t channel) {
  return *std::find_if(map.images.begin(), map.images.end(), [&](const FunctionImage& image) {
    return image.layer == layer && image.view == view && image.channel == channel && image.level == 0;
  });
}

/// The plain way: unpack the function, evaluate it.
double texel_value(const PenumbraMap& map, const FunctionImage& image, std::int64_t x, std::int64_t y,
                   double z) {
  const auto cx = static_cast<std::uint32_t>(std::clamp<std::int64_t>(x, 0, image.width - 1));
  const auto cy = static_cast<std::uint32_t>(std::clamp<std::int64_t>(y, 0, image.height - 1));
  const std::uint32_t bx = cx / kBlockSize, by = cy / kBlockSize;
  const auto extent = block_extent(image.width, image.height, bx, by);
  const FunctionBlock& block = image.blocks[by * image.blocks_across() + bx];
  const auto function = unpack_function(map.coding, block, cy % kBlockSize * extent[0] + cx % kBlockSize);
  return evaluate_function(map.views[image.view], map.coding, function, z);
}

/// Look-up as documented, straight from the definitions, for a point within the window of `view`.
double expected_value(const PenumbraMap& map, std::uint32_t view_index, const Point& p, Filter filter,
                      std::uint32_t channel = 0) {
  const View& view = map.views[view_index];
  const double w = view.projection == Projection::perspective ? p[2] : 1;
  const double u = (p[0] / w - view.window[0]) / (view.window[2] - view.window[0]) * view.width;
  const double v = (p[1] / w - view.window[1]) / (view.window[3] - view.window[1]) * view.height;
  double total = 0;
  for (std::uint32_t layer = 0; layer < map.layers.size(); ++layer) {
    const FunctionImage& image = base_image(map, layer, view_index, channel);
    const auto value = [&](double x, double y) {
      return texel_value(map, image, static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), p[2]);
    };
    double filtered = 0;
    if (filter == Filter::nearest) {
      filtered = value(std::floor(u), std::floor(v));
    } else {
      const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), a = u - 0.5 - x, b = v - 0.5 - y;
      filtered = (1 - b) * ((1 - a) * value(x, y) + a * value(x + 1, y)) +
                 b * ((1 - a) * value(x, y + 1) + a * value(x + 1, y + 1));
    }
    total =
        map.layer_rule == LayerRule::maximum ? std::max(total, filtered) : std::min(1.0, total + filtered);
  }
  return total;
}

/// A point of the window at a depth.
Point window_point(const View& view, double share_x, double share_y, double z) {
  const double w = view.projection == Projection::perspective ? z : 1;
  return {(view.window[0] + share_x * (view.window[2] - view.window[0])) * w,
          (view.window[1] + share_y * (view.window[3] - view.window[1])) * w, z};
}

Point random_point(Random& random, const View& view) {
  return window_point(
      view, random.real(0, 1), random.real(0, 1),
      random.real(view.near_depth, view.far_depth + 0.1 * (view.far_depth - view.near_depth)));
}

TEST(LookUp, AgreesWithThePlainEvaluationForEveryCoding) {
  std::uint64_t seed = 50;
  for (const VertexCoding& coding : testing::all_codings()) {
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
      SCOPED_TRACE(testing::name_of(coding));
      MapShape shape;
      shape.coding = coding;
      shape.projection = projection;
      shape.width = 70;
      const PenumbraMap map = random_map(++seed, shape);
      const PenumbraLookUp look_up(map);
      Random random(seed);
      for (int n = 0; n < 500; ++n) {
        const Point p = random_point(random, map.views[0]);
        for (Filter filter : {Filter::nearest, Filter::bilinear}) {
          const double expected = expected_value(map, 0, p, filter);
          EXPECT_NEAR(look_up.at_view_point(p, filter).attenuation, expected, kTwoUlp * expected + 1e-12);
        }
      }
    }
  }
}

TEST(LookUp, AgreesWithThePlainEvaluationForAnyMap) {
  EXPECT_TRUE(rc::check("at_view_point = definition", [](std::uint64_t seed) {
    const PenumbraMap map = random_map(seed, testing::random_shape(seed));
    const PenumbraLookUp look_up(map);
    Random random(seed);
    for (std::uint32_t view = 0; view < map.views.size(); ++view) {
      for (int n = 0; n < 20; ++n) {
        const Point p = random_point(random, map.views[view]);
        for (Filter filter : {Filter::nearest, Filter::bilinear}) {
          const LookUpResult result = look_up.at_view_point(p, filter, view);
          const auto is_near = [](double value, double expected) {
            return std::abs(value - expected) <= kTwoUlp * expected + 1e-12;
          };
          std::array<double, 3> expected{};
          for (std::uint32_t c = 0; c < 3; ++c) {
            expected[c] = expected_value(map, view, p, filter, map.channels == 3 ? c : 0);
            RC_ASSERT(is_near(result.rgb[c], expected[c]));
          }
          RC_ASSERT(is_near(result.attenuation,
                            0.2126 * expected[0] + 0.7152 * expected[1] + 0.0722 * expected[2]));
        }
      }
    }
  }));
}

TEST(LookUp, ChannelsAreMapsOfTheirOwn) {
  MapShape shape;
  shape.width = 70;
  shape.views = shape.layers = 2;
  shape.levels = 3;
  shape.channels = 3;
  const PenumbraMap map = random_map(4, shape);
  const PenumbraLookUp look_up(map);
  Random random(4);
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    const PenumbraMap one = testing::channel_of(map, channel);
    const PenumbraLookUp alone(one);
    for (int n = 0; n < 1000; ++n) {
      const Point p = to_world(map.views[0], random_point(random, map.views[0]));
      const double footprint = random.real(0, 1);
      EXPECT_EQ(look_up.at(p, Filter::bilinear, footprint).rgb[channel],
                alone.at(p, Filter::bilinear, footprint).attenuation);
    }
  }
}

/// Bilinear value of one layer's level, straight from the definitions.
double expected_level(const PenumbraMap& map, std::uint32_t level, double u, double v, double z) {
  const FunctionImage& image = *std::find_if(map.images.begin(), map.images.end(),
                                             [&](const FunctionImage& i) { return i.level == level; });
  const double shrink = std::exp2(-static_cast<double>(level));
  const double x = std::floor(u * shrink - 0.5), y = std::floor(v * shrink - 0.5);
  const double a = u * shrink - 0.5 - x, b = v * shrink - 0.5 - y;
  const auto value = [&](double i, double j) {
    return texel_value(map, image, static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), z);
  };
  return (1 - b) * ((1 - a) * value(x, y) + a * value(x + 1, y)) +
         b * ((1 - a) * value(x, y + 1) + a * value(x + 1, y + 1));
}

TEST(LookUp, AFootprintBlendsTheTwoMipLevelsAroundIt) {
  MapShape shape;
  shape.width = 37;
  shape.height = 21;
  shape.levels = 5;  // 21 >> 4 is 1
  shape.projection = Projection::orthographic;
  PenumbraMap map = random_map(9, shape);
  View& view = map.views[0];
  view.world_to_view = {};
  view.window = {0, 0, 18.5, 10.5};  // two texels a metre
  const PenumbraLookUp look_up(map);
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const double u = random.real(0, 37), v = random.real(0, 21),
                 z = random.real(view.near_depth, view.far_depth);
    const double footprint = random.real(0, 12);
    const double level = std::clamp(std::log2(std::max(2 * footprint / std::sqrt(3.0), 1.0)), 0.0, 4.0);
    const auto fine = static_cast<std::uint32_t>(level);
    const double share = level - fine;
    const double expected = (1 - share) * expected_level(map, fine, u, v, z) +
                            share * expected_level(map, std::min(fine + 1, 4U), u, v, z);
    EXPECT_NEAR(look_up.at({u / 2, v / 2, z}, Filter::bilinear, footprint).attenuation, expected, 1e-6);
  }
}

/// One texel; near 1, far 65536, so that code d is depth 1 + d.
PenumbraMap one_texel_map(const std::vector<FunctionVertex>& function, const VertexCoding& coding = {}) {
  PenumbraMap map;
  map.coding = coding;
  View view;
  view.near_depth = 1;
  view.far_depth = 65536;
  view.width = view.height = 1;
  map.views = {view};
  FunctionImage image{0, 0, 0, 0, 1, 1, {testing::make_block(coding, {function})}};
  map.images = {image};
  return map;
}

/// Functions of many lengths with a vertex at every depth that is probed, and just beside.
TEST(LookUp, IsLeftContinuousAtEveryVertex) {
  for (const VertexCoding& coding : testing::all_codings()) {
    for (std::uint32_t count : {1U, 2U, 3U, 5U, 8U, 100U}) {
      SCOPED_TRACE(testing::name_of(coding) + ", vertices: " + std::to_string(count));
      Random random(count);
      const auto function = testing::random_function(random, coding, count);
      PenumbraMap map = one_texel_map(function, coding);
      map.views[0].near_depth = random.real(0.1, 10);
      map.views[0].far_depth = map.views[0].near_depth + random.real(0.1, 100);
      const PenumbraLookUp look_up(map);
      for (const FunctionVertex& vertex : function) {
        const double jump = decode_depth(map.views[0], coding, vertex.depth);
        for (double z : {std::nextafter(jump, 0), jump, std::nextafter(jump, 1e9)}) {
          const double expected = evaluate_function(map.views[0], coding, function, z);
          EXPECT_NEAR(look_up.at_view_point({0, 0, z}, Filter::nearest).attenuation, expected,
                      kTwoUlp * expected + 1e-12);
        }
      }
    }
  }
}

/// Relative to each value, also to tiny ones, and where near and far are close for their size.
TEST(LookUp, IsWithinTwoUlpOfThePlainEvaluation) {
  EXPECT_TRUE(rc::check("nearest = evaluate_function to 2 ulp", [](std::uint64_t seed) {
    Random random(seed);
    const VertexCoding coding{16, 16, 65535};
    const auto function = testing::random_function(random, coding, 8);
    PenumbraMap map = one_texel_map(function, coding);
    map.views[0].near_depth = random.real(0.1, 10);
    map.views[0].far_depth =
        map.views[0].near_depth * (1 + random.real(0.1, 1) * std::exp2(random.real(-10, 10)));
    const PenumbraLookUp look_up(map);
    const View& view = map.views[0];
    for (int n = 0; n < 200; ++n) {
      double z = random.real(view.near_depth, view.far_depth);
      const double vertex = decode_depth(view, coding, function[random.below(8)].depth);
      if (n % 2 == 0) z = vertex + depth_step(view, coding) * std::exp2(random.real(-20, 0));
      const auto expected = static_cast<float>(evaluate_function(view, coding, function, z));
      const float value = look_up.at_view_point({0, 0, z}, Filter::nearest).attenuation;
      RC_ASSERT(std::abs(value - expected) <= 2 * (std::nextafter(expected, 2.0F) - expected));
    }
  }));
}

TEST(LookUp, JumpsAreExact) {
  const PenumbraMap map = one_texel_map({{10, 51, 102}, {20, 255, 255}});
  const PenumbraLookUp look_up(map);
  const auto at = [&](double z) { return look_up.at_view_point({0, 0, z}, Filter::bilinear).attenuation; };
  EXPECT_EQ(at(11), 0.0F);
  EXPECT_NEAR(at(std::nextafter(11, 12)), 0.2F, 1e-7);
  EXPECT_FLOAT_EQ(at(16), 0.3F);
  EXPECT_EQ(at(21), 0.4F);
  EXPECT_EQ(at(std::nextafter(21, 22)), 1.0F);
  EXPECT_EQ(at(1e6), 1.0F);
}

TEST(LookUp, EmptyFunctionIsZeroEverywhere) {
  const PenumbraMap map = one_texel_map({});
  const PenumbraLookUp look_up(map);
  for (double z : {1.0, 2.0, 65536.0, 1e9})
    EXPECT_EQ(look_up.at_view_point({0, 0, z}, Filter::nearest).attenuation, 0.0F);
}

/// 2 x 1 texels, values 0.2 and 0.6 from the start, domain ends at codes 100 and 200.
PenumbraMap two_texel_map() {
  PenumbraMap map = one_texel_map({});
  map.views[0].width = 2;
  map.images[0].width = 2;
  map.images[0].blocks[0] = testing::make_block(map.coding, {{{0, 51, 51}}, {{0, 153, 153}}});
  map.images[0].blocks[0].domain_end = {100, 200};
  return map;
}

TEST(LookUp, WeightsAreFromTexelCentresAndBordersClamp) {
  const PenumbraMap map = two_texel_map();
  const PenumbraLookUp look_up(map);
  const auto at = [&](double x, Filter filter) {
    return look_up.at_view_point({x * 10, 0, 10}, filter).attenuation;
  };
  EXPECT_FLOAT_EQ(at(-1, Filter::bilinear), 0.2F);
  EXPECT_FLOAT_EQ(at(-0.5, Filter::bilinear), 0.2F);
  EXPECT_FLOAT_EQ(at(-0.25, Filter::bilinear), 0.3F);
  EXPECT_FLOAT_EQ(at(0, Filter::bilinear), 0.4F);
  EXPECT_FLOAT_EQ(at(0.5, Filter::bilinear), 0.6F);
  EXPECT_FLOAT_EQ(at(1, Filter::bilinear), 0.6F);
  EXPECT_FLOAT_EQ(at(-0.01, Filter::nearest), 0.2F);
  EXPECT_FLOAT_EQ(at(0.01, Filter::nearest), 0.6F);
  EXPECT_FLOAT_EQ(at(1, Filter::nearest), 0.6F);
}

TEST(LookUp, StatusOfEveryRegion) {
  const PenumbraMap map = two_texel_map();
  const PenumbraLookUp look_up(map);
  for (Filter filter : {Filter::nearest, Filter::bilinear}) {
    const auto status = [&](const Point& p) { return look_up.at_view_point(p, filter).status; };
    EXPECT_EQ(status({0, 0, 50}), PointStatus::inside);
    EXPECT_EQ(status({0, 0, -1}), PointStatus::behind);
    EXPECT_EQ(status({0, 0, 0}), PointStatus::behind);
    EXPECT_EQ(status({0, 0, 0.999}), PointStatus::outside);
    EXPECT_EQ(status({0, 0, 1}), PointStatus::inside);
    // The window's border belongs to it.
    for (double side : {-1.0, 1.0}) {
      EXPECT_EQ(status({side * 3, 0, 3}), PointStatus::inside);
      EXPECT_EQ(status({0, side * 3, 3}), PointStatus::inside);
      EXPECT_EQ(status({side * std::nextafter(3, 4), 0, 3}), PointStatus::outside);
      EXPECT_EQ(status({0, side * std::nextafter(3, 4), 3}), PointStatus::outside);
    }
    // Domain ends at depth 101 and 201; the texel that holds the point decides.
    EXPECT_EQ(status({-1, 0, 101}), PointStatus::inside);
    EXPECT_EQ(status({-1, 0, std::nextafter(101, 102)}), PointStatus::past_end);
    EXPECT_EQ(status({1, 0, 201}), PointStatus::inside);
    EXPECT_EQ(status({1, 0, std::nextafter(201, 202)}), PointStatus::past_end);
  }
}

TEST(LookUp, ValueOutsideIsZeroAndPastEndIsHeld) {
  const PenumbraMap map = two_texel_map();
  const PenumbraLookUp look_up(map);
  const auto at = [&](const Point& p) { return look_up.at_view_point(p, Filter::bilinear).attenuation; };
  EXPECT_EQ(at({0, 0, -1}), 0.0F);
  EXPECT_EQ(at({0, 0, 0.5}), 0.0F);
  EXPECT_EQ(at({4, 0, 3}), 0.0F);
  EXPECT_FLOAT_EQ(at({-1000, 0, 1001}), 0.2F);
}

TEST(LookUp, WithoutDomainEndsTheDomainReachesFar) {
  PenumbraMap map = two_texel_map();
  map.images[0].blocks[0].domain_end.clear();
  const PenumbraLookUp look_up(map);
  EXPECT_EQ(look_up.at_view_point({0, 0, 65536}, Filter::nearest).status, PointStatus::inside);
  EXPECT_EQ(look_up.at_view_point({0, 0, 65537}, Filter::nearest).status, PointStatus::past_end);
}

TEST(LookUp, NansAreOutside) {
  PenumbraMap map = two_texel_map();
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    map.views[0].projection = projection;
    const PenumbraLookUp look_up(map);
    for (const Point& p : {Point{nan, 0, 2}, Point{0, nan, 2}, Point{0, 0, nan}, Point{infinity, 0, 2},
                           Point{nan, nan, nan}, Point{infinity, infinity, infinity}}) {
      const LookUpResult result = look_up.at(p, Filter::bilinear);
      EXPECT_EQ(result.attenuation, 0.0F);
      EXPECT_EQ(result.status, PointStatus::outside);
    }
  }
}

/// In a view that is turned by any angles, one infinite coordinate makes all three infinite.
TEST(LookUp, NothingIsSeenAtInfinity) {
  PenumbraMap map = two_texel_map();
  Random random(4);
  map.views[0].world_to_view = testing::random_motion(random);
  const double infinity = std::numeric_limits<double>::infinity();
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    map.views[0].projection = projection;
    const PenumbraLookUp look_up(map);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (double coordinate : {-infinity, infinity}) {
        Point p{1, 2, 3};
        p[axis] = coordinate;
        const LookUpResult result = look_up.at(p, Filter::bilinear);
        EXPECT_EQ(result.attenuation, 0.0F);
        EXPECT_TRUE(result.status == PointStatus::outside || result.status == PointStatus::behind);
      }
    }
  }
}

TEST(LookUp, OrthographicTakesMetresAndHasNoBehind) {
  PenumbraMap map = two_texel_map();
  map.views[0].projection = Projection::orthographic;
  map.views[0].near_depth = -10;
  const PenumbraLookUp look_up(map);
  EXPECT_FLOAT_EQ(look_up.at_view_point({-0.5, 0, 100}, Filter::bilinear).attenuation, 0.2F);
  EXPECT_FLOAT_EQ(look_up.at_view_point({-0.5, 0, -9}, Filter::bilinear).attenuation, 0.2F);
  EXPECT_EQ(look_up.at_view_point({0, 0, -11}, Filter::nearest).status, PointStatus::outside);
}

TEST(LookUp, WorldPointsGoThroughTheViewsMotion) {
  EXPECT_TRUE(rc::check("points of the window are inside", [](std::uint64_t seed) {
    MapShape shape = testing::random_shape(seed);
    shape.views = 1;
    // Far from the origin: in float the motion would lose everything.
    PenumbraMap map = random_map(seed, shape);
    for (double& value : map.views[0].world_to_view.translation) value += 1e6;
    for (FunctionImage& image : map.images)
      for (FunctionBlock& block : image.blocks) block.domain_end.clear();
    const PenumbraLookUp look_up(map);
    Random random(seed);
    for (int n = 0; n < 20; ++n) {
      const View& view = map.views[0];
      const Point p = window_point(view, random.real(0.01, 0.99), random.real(0.01, 0.99),
                                   random.real(view.near_depth + 0.01, view.far_depth - 0.01));
      RC_ASSERT(look_up.at(to_world(view, p), Filter::nearest).status == PointStatus::inside);
    }
  }));
}

TEST(LookUp, WorldValueOfAKnownMotion) {
  PenumbraMap map = two_texel_map();
  // World y down is view z; world x is view x.
  map.views[0].world_to_view = {{1, 0, 0, 0, 0, 1, 0, -1, 0}, {-1e6, 0, 1e6}};
  const PenumbraLookUp look_up(map);
  const LookUpResult result = look_up.at({1e6 - 2.5, 1e6 - 10, 0}, Filter::bilinear);
  EXPECT_FLOAT_EQ(result.attenuation, 0.3F);
  EXPECT_EQ(result.status, PointStatus::inside);
  EXPECT_EQ(look_up.at({1e6, 1e6 + 1, 0}, Filter::nearest).status, PointStatus::behind);
}

/// Two faces that look in opposite directions, and one that overlaps the first.
TEST(LookUp, ThePointBelongsToTheFirstViewThatHoldsIt) {
  PenumbraMap map = one_texel_map({{0, 51, 51}});
  map.views.push_back(map.views[0]);
  map.views[1].world_to_view.rotation = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
  map.views.push_back(map.views[0]);
  map.views[2].window = {-2, -2, 2, 2};
  for (std::uint32_t view : {1U, 2U}) {
    FunctionImage image = map.images[0];
    image.view = view;
    image.blocks[0] = testing::make_block(map.coding, {{{0, 51 * (view + 1), 51 * (view + 1)}}});
    map.images.push_back(image);
  }
  const PenumbraLookUp look_up(map);
  EXPECT_FLOAT_EQ(look_up.at({0, 0, 10}, Filter::nearest).attenuation, 0.2F);
  EXPECT_FLOAT_EQ(look_up.at({0, 0, -10}, Filter::nearest).attenuation, 0.4F);
  EXPECT_FLOAT_EQ(look_up.at({15, 0, 10}, Filter::nearest).attenuation, 0.6F);
  EXPECT_EQ(look_up.at({0, 0, -10}, Filter::nearest).status, PointStatus::inside);
  EXPECT_EQ(look_up.at({15, 0, -10}, Filter::nearest).status, PointStatus::outside);
  EXPECT_EQ(look_up.at({0, 0, 0}, Filter::nearest).status, PointStatus::behind);
}

TEST(LookUp, LayersCombineByTheRule) {
  PenumbraMap map = two_texel_map();
  map.layers.push_back("doors");
  FunctionImage image = map.images[0];
  image.layer = 1;
  image.blocks[0] = testing::make_block(map.coding, {{{0, 102, 102}}, {{0, 128, 128}}});
  image.blocks[0].domain_end = {50, 400};
  map.images.push_back(image);
  const Point left{-50, 0, 100}, right{50, 0, 100};
  {
    const PenumbraLookUp look_up(map);
    EXPECT_FLOAT_EQ(look_up.at_view_point(left, Filter::nearest).attenuation, 0.4F);
    EXPECT_FLOAT_EQ(look_up.at_view_point(right, Filter::nearest).attenuation, 0.6F);
    // One layer's domain ends before: the value is no longer exact.
    EXPECT_EQ(look_up.at_view_point(left, Filter::nearest).status, PointStatus::past_end);
    EXPECT_EQ(look_up.at_view_point(right, Filter::nearest).status, PointStatus::inside);
  }
  map.layer_rule = LayerRule::clamped_sum;
  const PenumbraLookUp look_up(map);
  EXPECT_FLOAT_EQ(look_up.at_view_point(left, Filter::nearest).attenuation, 0.6F);
  EXPECT_EQ(look_up.at_view_point(right, Filter::nearest).attenuation, 1.0F);
}

TEST(LookUp, BatchesGiveTheSameBits) {
  EXPECT_TRUE(rc::check("attenuations[n] = at(n)", [](std::uint64_t seed) {
    const PenumbraMap map = random_map(seed, testing::random_shape(seed));
    const PenumbraLookUp look_up(map);
    Random random(seed);
    std::vector<Point> points;
    const std::size_t count = random.below(70);
    for (std::size_t n = 0; n < count; ++n) {
      const View& view = map.views[random.below(map.views.size())];
      Point p = random_point(random, view);
      if (random.chance(0.2)) p[2] -= view.far_depth;
      points.push_back(to_world(view, p));
    }
    std::vector<float> values(count, -1);
    for (Filter filter : {Filter::nearest, Filter::bilinear}) {
      look_up.attenuations(points, filter, values);
      for (std::size_t n = 0; n < count; ++n)
        RC_ASSERT(values[n] == look_up.at(points[n], filter).attenuation);
    }
  }));
}

TEST(LookUp, CopiesLookUpTheSame) {
  const PenumbraMap map = two_texel_map();
  const PenumbraLookUp look_up(map);
  const PenumbraLookUp copy = look_up;  // NOLINT: the copy is the point
  EXPECT_FLOAT_EQ(copy.at_view_point({0, 0, 10}, Filter::bilinear).attenuation, 0.4F);
}

}  // namespace
}  // namespace pdsm
