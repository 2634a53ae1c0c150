// SPDX-License-Identifier: Apache-2.0
#include "gpu_look_up.h"

#include <gtest/gtest.h>

namespace pdsm {
namespace {

using testing::EglContext;
using testing::FloatPoint;
using testing::GlApi;
using testing::MapShape;
using testing::Random;
using testing::random_map;

constexpr std::array kLayouts{TextureLayout::two_level, TextureLayout::fixed_depth};
constexpr std::array kFilters{Filter::nearest, Filter::bilinear};

std::string name_of(GlApi api) {
  return testing::version_line(api);
}

/// Holds the GPU to the look-up at `count` points of map `n` of the set, for both filters.
void expect_agreement(ShadowTextures& shadows, GlApi api, const PenumbraMap& map, std::uint32_t n,
                      std::size_t count, ShaderScope scope = ShaderScope::any_maps) {
  const PenumbraLookUp look_up(map);
  Random random(n + 1);
  const std::vector<FloatPoint> points = testing::points_to_try(random, map, count);
  for (const Filter filter : kFilters) {
    shadows.set_look_up(n, {filter, 0});
    const std::vector<float> values =
        testing::gpu_look_up(shadows, api, n, points, "pdsm_attenuation(map, position)", scope);
    for (std::size_t p = 0; p < points.size(); ++p) {
      ASSERT_TRUE(testing::may_say(values[p], map, look_up, points[p], filter))
          << points[p][0] << ' ' << points[p][1] << ' ' << points[p][2];
    }
  }
}

TEST(GpuLookUp, AgreesWithTheCpuAtAHundredThousandPoints) {
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  MapShape shape;
  shape.width = 130;
  shape.height = 70;
  shape.views = 2;
  const PenumbraMap map = random_map(11, shape);
  const PenumbraMap* const maps[] = {&map};
  for (const TextureLayout layout : kLayouts) {
    shadows.upload(maps, layout);
    expect_agreement(shadows, GlApi::core_33, map, 0, 100'000);
  }
}

TEST(GpuLookUp, AgreesWithTheCpuForEveryCodingInOneSet) {
  std::vector<PenumbraMap> maps;
  for (const VertexCoding& coding : testing::all_codings()) {
    MapShape shape;
    shape.coding = coding;
    shape.width = 70;
    shape.layers = maps.size() % 2 == 0 ? 1 : 2;
    shape.projection = maps.size() % 3 == 0 ? Projection::orthographic : Projection::perspective;
    maps.push_back(random_map(maps.size(), shape));
  }
  std::vector<const PenumbraMap*> pointers;
  for (const PenumbraMap& map : maps) pointers.push_back(&map);
  for (const GlApi api : {GlApi::core_33, GlApi::core_45, GlApi::es_30}) {
    SCOPED_TRACE(name_of(api));
    const EglContext context(api);
    ShadowTextures shadows(EglContext::loader());
    for (const TextureLayout layout : kLayouts) {
      shadows.upload(pointers, layout);
      for (std::uint32_t n = 0; n < maps.size(); ++n) expect_agreement(shadows, api, maps[n], n, 2000);
    }
  }
}

TEST(GpuLookUp, AgreesWithTheCpuOnChannels) {
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  MapShape shape;
  shape.width = 70;
  shape.layers = 2;
  shape.channels = 3;
  const PenumbraMap map = random_map(6, shape);
  const PenumbraMap* const maps[] = {&map};
  shadows.upload(maps, TextureLayout::two_level);
  Random random(1);
  const std::vector<FloatPoint> points = testing::points_to_try(random, map, 3000);
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    const PenumbraMap one = testing::channel_of(map, channel);
    const PenumbraLookUp look_up(one);
    const std::string component(1, "xyz"[channel]);
    const auto blocked = testing::gpu_look_up(shadows, GlApi::core_33, 0, points,
                                              "pdsm_attenuation_rgb(map, position)." + component);
    const auto arrives = testing::gpu_look_up(shadows, GlApi::core_33, 0, points,
                                              "pdsm_visibility_rgb(map, position, vec3(0.0))." + component);
    for (std::size_t n = 0; n < points.size(); ++n) {
      ASSERT_TRUE(testing::may_say(blocked[n], one, look_up, points[n], Filter::bilinear)) << n;
      ASSERT_FLOAT_EQ(arrives[n], 1 - blocked[n]) << n;
    }
  }
}

TEST(GpuLookUp, AgreesWithTheCpuOnMipLevels) {
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  MapShape shape;
  shape.width = 70;
  shape.height = 37;
  shape.levels = 6;
  const PenumbraMap map = random_map(5, shape);
  const PenumbraMap* const maps[] = {&map};
  const PenumbraLookUp look_up(map);
  Random random(1);
  const std::vector<FloatPoint> points = testing::points_to_try(random, map, 3000);
  for (const TextureLayout layout : kLayouts) {
    shadows.upload(maps, layout);
    for (const float footprint : {0.1F, 0.7F, 3.0F, 100.0F}) {
      const std::string expression = "pdsm_attenuation(map, position, " + std::to_string(footprint) + ")";
      const auto values = testing::gpu_look_up(shadows, GlApi::core_33, 0, points, expression);
      for (std::size_t n = 0; n < points.size(); ++n)
        ASSERT_TRUE(testing::may_say(values[n], map, look_up, points[n], Filter::bilinear,
                                     static_cast<double>(footprint)))
            << n << " footprint " << footprint;
    }
  }
}

TEST(GpuLookUp, AgreesWithTheCpuWhenCompiledForTheseMaps) {
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const PenumbraMap map = random_map(seed, testing::random_shape(seed));
    const PenumbraMap* const maps[] = {&map};
    for (const TextureLayout layout : kLayouts) {
      shadows.upload(maps, layout);
      expect_agreement(shadows, GlApi::core_33, map, 0, 2000, ShaderScope::these_maps);
    }
  }
}

/// Orthographic, looking along +z, 8 x 8 texels of 1 m, near 1, far 65536: texel (i, j) has its centre at
/// (i + 1/2, j + 1/2), depth code d is at 1 + d. All of that is exact in floats.
PenumbraMap integer_map() {
  MapShape shape;
  shape.width = shape.height = 8;
  shape.most_vertices = 30;
  shape.empty_share = 0.1;
  PenumbraMap map = random_map(21, shape);
  View& view = map.views[0];
  view.world_to_view = {};
  view.projection = Projection::orthographic;
  view.window = {0, 0, 8, 8};
  view.near_depth = 1;
  view.far_depth = 65536;
  return map;
}

/// Within a ramp, a float may be off by the roundings of share, product, sum and quotient, half an ulp of 1
/// each.
constexpr double kRampRounding = 0x1p-22;

TEST(GpuLookUp, IsExactWhenFedLightSpaceIntegers) {
  const PenumbraMap map = integer_map();
  std::vector<FloatPoint> at_vertices, behind;
  for (std::uint32_t t = 0; t < 64; ++t) {
    for (const FunctionVertex& vertex : unpack_function(map.coding, map.images[0].blocks[0], t)) {
      // At the vertex, where V has not jumped yet, and one code behind it, where it has.
      const float x = static_cast<float>(t % 8) + 0.5F, y = static_cast<float>(t / 8) + 0.5F;
      at_vertices.push_back({x, y, 1 + static_cast<float>(vertex.depth)});
      behind.push_back({x, y, 2 + static_cast<float>(vertex.depth)});
    }
  }
  ASSERT_GT(at_vertices.size(), 500U);
  const PenumbraLookUp look_up(map);
  const auto expected = [&](const FloatPoint& p) {
    return look_up.at({p[0], p[1], p[2]}, Filter::nearest).attenuation;
  };
  const PenumbraMap* const maps[] = {&map};
  for (const GlApi api : {GlApi::core_33, GlApi::es_30}) {
    const EglContext context(api);
    ShadowTextures shadows(EglContext::loader());
    for (const TextureLayout layout : kLayouts) {
      shadows.upload(maps, layout);
      // At texel centres, bilinear must not mix anything in.
      for (const Filter filter : kFilters) {
        shadows.set_look_up(0, {filter, 0});
        const auto exact = testing::gpu_look_up(shadows, api, 0, at_vertices);
        const auto near = testing::gpu_look_up(shadows, api, 0, behind);
        for (std::size_t n = 0; n < exact.size(); ++n) {
          ASSERT_EQ(exact[n], expected(at_vertices[n])) << n;
          ASSERT_NEAR(near[n], expected(behind[n]), kRampRounding) << n;
        }
      }
    }
  }
}

TEST(GpuLookUp, VisibilityIsOneMinusAttenuationAndMovesAlongTheNormal) {
  const PenumbraMap map = integer_map();
  const PenumbraMap* const maps[] = {&map};
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  shadows.upload(maps);
  // Two texels of 1 m each towards +x.
  shadows.set_look_up(0, {Filter::bilinear, 2});
  Random random(4);
  std::vector<FloatPoint> points, moved;
  for (int n = 0; n < 500; ++n) {
    const FloatPoint p{static_cast<float>(random.below(500)) / 64, static_cast<float>(random.below(500)) / 64,
                       static_cast<float>(random.below(60000))};
    points.push_back(p);
    moved.push_back({p[0] + 2, p[1], p[2]});
  }
  const auto visibility = testing::gpu_look_up(shadows, GlApi::core_33, 0, points,
                                               "pdsm_visibility(map, position, vec3(1.0, 0.0, 0.0))");
  const auto still =
      testing::gpu_look_up(shadows, GlApi::core_33, 0, points, "pdsm_visibility(map, position, normal)");
  const auto attenuation = testing::gpu_look_up(shadows, GlApi::core_33, 0, moved);
  const auto here = testing::gpu_look_up(shadows, GlApi::core_33, 0, points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    EXPECT_EQ(still[n], 1 - here[n]);
    EXPECT_EQ(visibility[n], 1 - attenuation[n]) << points[n][0];
  }
}

}  // namespace
}  // namespace pdsm
