// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/map_textures.h"

#include <gtest/gtest.h>

#include <string>

#include "float_points.h"
#include "pdsm/format/error.h"
#include "shader_mirror.h"

namespace pdsm {
namespace {

using testing::FloatPoint;
using testing::MapShape;
using testing::mirror_attenuation;
using testing::Random;
using testing::random_map;

constexpr std::array kLayouts{TextureLayout::two_level, TextureLayout::fixed_depth};

std::vector<const PenumbraMap*> pointers(const std::vector<PenumbraMap>& maps) {
  std::vector<const PenumbraMap*> result;
  for (const PenumbraMap& map : maps) result.push_back(&map);
  return result;
}

/// Holds the mirror of the shader to the look-up at many points of each map.
void expect_agreement(const std::vector<PenumbraMap>& maps, TextureLayout layout, std::size_t points) {
  MapTextures textures = make_map_textures(pointers(maps), layout);
  for (std::uint32_t n = 0; n < maps.size(); ++n) {
    const PenumbraLookUp look_up(maps[n]);
    Random random(n + 1);
    for (const FloatPoint& p : testing::points_to_try(random, maps[n], points)) {
      for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
        set_look_up(textures.tables, n, {filter, 0});
        const float value = mirror_attenuation(textures, n, p);
        ASSERT_TRUE(testing::may_say(value, maps[n], look_up, p, filter))
            << "map " << n << " at " << p[0] << ' ' << p[1] << ' ' << p[2];
      }
    }
  }
}

TEST(MapTextures, ShaderAgreesWithTheLookUpForEveryCoding) {
  for (const VertexCoding& coding : testing::all_codings()) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
      SCOPED_TRACE(testing::name_of(coding));
      MapShape shape;
      shape.coding = coding;
      shape.projection = projection;
      shape.width = 70;
      for (const TextureLayout layout : kLayouts) expect_agreement({random_map(7, shape)}, layout, 500);
    }
  }
}

TEST(MapTextures, ShaderAgreesWithTheLookUpForSetsOfAnyMaps) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<PenumbraMap> maps;
    for (std::uint64_t n = 0; n < 7; ++n)
      maps.push_back(random_map(10 * seed + n, testing::random_shape(10 * seed + n)));
    for (const TextureLayout layout : kLayouts) expect_agreement(maps, layout, 200);
  }
}

TEST(MapTextures, ChannelsAreMapsOfTheirOwn) {
  MapShape shape;
  shape.width = 70;
  shape.views = shape.layers = 2;
  shape.levels = 2;
  shape.channels = 3;
  const PenumbraMap map = random_map(12, shape);
  const PenumbraMap* const maps[] = {&map};
  const MapTextures two_level = make_map_textures(maps, TextureLayout::two_level),
                    fixed_depth = make_map_textures(maps, TextureLayout::fixed_depth);
  testing::TwoLevelMirror two_level_mirror(two_level);
  testing::FixedDepthMirror fixed_depth_mirror(fixed_depth);
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    const PenumbraMap one = testing::channel_of(map, channel);
    const PenumbraLookUp look_up(one);
    Random random(channel + 1);
    for (const FloatPoint& p : testing::points_to_try(random, map, 1000)) {
      for (const float value :
           {two_level_mirror.pdsm_channel_at(0, channel, p[0], p[1], p[2], 0, 0, 0, 0),
            fixed_depth_mirror.pdsm_channel_at(0, channel, p[0], p[1], p[2], 0, 0, 0, 0)}) {
        ASSERT_TRUE(testing::may_say(value, one, look_up, p, Filter::bilinear))
            << p[0] << ' ' << p[1] << ' ' << p[2];
      }
    }
  }
}

TEST(MapTextures, ChannelsThatAreEqualShareTheirVertices) {
  MapShape shape;
  const PenumbraMap grey = random_map(13, shape);
  PenumbraMap map = grey;
  map.channels = 3;
  for (std::uint32_t channel : {1U, 2U}) {
    map.images.push_back(grey.images[0]);
    map.images.back().channel = channel;
  }
  const PenumbraMap *const one[] = {&grey}, *const three[] = {&map};
  const MapTextures a = make_map_textures(one, TextureLayout::two_level),
                    b = make_map_textures(three, TextureLayout::two_level);
  EXPECT_EQ(b.vertices.words, a.vertices.words);
  EXPECT_EQ(b.index.bytes(), 3 * a.index.bytes());
}

TEST(MapTextures, ShaderAgreesWithTheLookUpOnMipLevels) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    MapShape shape = testing::random_shape(seed);
    shape.width = 33;
    shape.height = 20;
    shape.levels = 5;
    const PenumbraMap map = random_map(seed, shape);
    const PenumbraMap* const maps[] = {&map};
    const PenumbraLookUp look_up(map);
    Random random(seed);
    for (const TextureLayout layout : kLayouts) {
      const MapTextures textures = make_map_textures(maps, layout);
      for (const FloatPoint& p : testing::points_to_try(random, map, 300)) {
        const auto footprint = static_cast<float>(random.real(0, 3));
        const float value = mirror_attenuation(textures, 0, p, footprint);
        ASSERT_TRUE(
            testing::may_say(value, map, look_up, p, Filter::bilinear, static_cast<double>(footprint)))
            << p[0] << ' ' << p[1] << ' ' << p[2] << " footprint " << footprint;
      }
    }
  }
}

/// 1 x 1 texels, near 1, far 65536, looking along +z: depth code d is at 1 + d.
PenumbraMap one_texel_map(const std::vector<FunctionVertex>& function) {
  PenumbraMap map;
  View view;
  view.near_depth = 1;
  view.far_depth = 65536;
  view.width = view.height = 1;
  map.views = {view};
  FunctionImage image;
  image.width = image.height = 1;
  image.blocks = {testing::make_block(map.coding, {function})};
  map.images = {image};
  return map;
}

TEST(MapTextures, ShaderIsExactAtIntegers) {
  // A jump to 51, a ramp to 255 over four codes, a drop to 102 for good.
  const PenumbraMap map = one_texel_map({{9, 51, 51}, {19, 51, 255}, {23, 102, 102}});
  const PenumbraMap* const maps[] = {&map};
  for (const TextureLayout layout : kLayouts) {
    const MapTextures textures = make_map_textures(maps, layout);
    const auto value = [&](float z) { return mirror_attenuation(textures, 0, {0, 0, z}); };
    EXPECT_EQ(value(1), 0 / 255.0F);
    EXPECT_EQ(value(10), 0 / 255.0F);  // left-continuous
    EXPECT_EQ(value(11), 51 / 255.0F);
    EXPECT_EQ(value(20), 51 / 255.0F);
    EXPECT_EQ(value(21), 102 / 255.0F);
    EXPECT_EQ(value(22), 153 / 255.0F);
    EXPECT_EQ(value(24), 255 / 255.0F);
    EXPECT_EQ(value(25), 102 / 255.0F);
    EXPECT_EQ(value(65536), 102 / 255.0F);
    EXPECT_EQ(value(1e6F), 102 / 255.0F);
  }
}

TEST(MapTextures, ShaderIsLitAtNearAndBefore) {
  const PenumbraMap map = one_texel_map({{0, 51, 51}});  // blocked from near on
  const PenumbraMap* const maps[] = {&map};
  for (const TextureLayout layout : kLayouts) {
    const MapTextures textures = make_map_textures(maps, layout);
    EXPECT_EQ(mirror_attenuation(textures, 0, {0, 0, 1.5F}), 51 / 255.0F);
    for (const float z : {1.0F, 0.5F, 0.0F, -1.0F})
      EXPECT_EQ(mirror_attenuation(textures, 0, {0, 0, z}), 0) << z;
  }
}

TEST(MapTextures, EqualFunctionsAreStoredOnce) {
  PenumbraMap map = one_texel_map({});
  map.views[0].width = 8;
  FunctionImage& image = map.images[0];
  image.width = 8;
  const std::vector<FunctionVertex> a{{9, 51, 51}, {19, 51, 255}, {23, 102, 102}}, b{{9, 51, 51}};
  image.blocks = {testing::make_block(map.coding, {a, b, a, {}, b, a, a, b})};
  const PenumbraMap* const maps[] = {&map};
  const MapTextures textures = make_map_textures(maps, TextureLayout::two_level);
  EXPECT_EQ(textures.vertices.words.size(), 4U);  // three of a, one of b
  EXPECT_EQ(textures.index.bytes(), 8U * 4U);
}

TEST(MapTextures, AnEmptySetAndEmptyMapsAreLit) {
  EXPECT_EQ(make_map_textures({}, TextureLayout::two_level).map_count, 0U);
  const PenumbraMap map = one_texel_map({});
  const PenumbraMap* const maps[] = {&map};
  for (const TextureLayout layout : kLayouts)
    EXPECT_EQ(mirror_attenuation(make_map_textures(maps, layout), 0, {0, 0, 100}), 0);
}

TEST(MapTextures, AnOriginKeepsScenesThatLieFarAway) {
  // The map moved by 2^20 m: world positions in float would have steps of 1/16 m there.
  MapShape shape;
  shape.width = shape.height = 40;
  PenumbraMap map = random_map(3, shape);
  const PenumbraMap here = map;
  const std::array<double, 3> far_away{0x1p20, -0x1p20, 0x1.8p20};
  auto& motion = map.views[0].world_to_view;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t a = 0; a < 3; ++a) motion.translation[row] -= motion.rotation[3 * row + a] * far_away[a];
  const PenumbraMap* const moved[] = {&map};
  const MapTextures textures = make_map_textures(moved, TextureLayout::two_level, {}, far_away);
  const PenumbraLookUp look_up(here);
  Random random(5);
  for (const FloatPoint& p : testing::points_to_try(random, here, 500)) {
    const float value = mirror_attenuation(textures, 0, p);
    ASSERT_TRUE(testing::may_say(value, here, look_up, p, Filter::bilinear));
  }
}

TEST(MapTextures, TheReceiverIsMovedAlongItsNormal) {
  // Blocked from depth 101 on. A texel at depth z is 2 z wide (window -1 .. 1, one texel), so that half a
  // texel towards the light lifts a receiver at 120 to 0: lit. Along the other way it stays blocked.
  const PenumbraMap map = one_texel_map({{100, 255, 255}});
  const PenumbraMap* const maps[] = {&map};
  MapTextures textures = make_map_textures(maps, TextureLayout::two_level);
  set_look_up(textures.tables, 0, {Filter::bilinear, 0.1F});  // 24 m at depth 120
  testing::TwoLevelMirror mirror(textures);
  EXPECT_EQ(mirror.pdsm_attenuation_at(0, 0, 0, 120, 0, 0, -1, 0), 0);
  EXPECT_EQ(mirror.pdsm_attenuation_at(0, 0, 0, 120, 0, 0, 1, 0), 1);
  EXPECT_EQ(mirror.pdsm_attenuation_at(0, 0, 0, 120, 0, 0, 0, 0), 1);
}

TEST(MapTextures, ConstantsSayWhatAllMapsHaveInCommon) {
  const PenumbraMap plain = one_texel_map({});
  MapShape shape;
  shape.coding = {32, 16, 65535};
  shape.layers = 2;
  shape.views = 2;
  shape.levels = 2;
  shape.projection = Projection::orthographic;
  const PenumbraMap other = random_map(1, shape);
  const auto constants = [](const std::vector<const PenumbraMap*>& maps) {
    return shader_constants(make_map_textures(maps, TextureLayout::two_level));
  };
  EXPECT_EQ(constants({&plain, &plain}),
            "#define PDSM_ONLY_FORM 1u\n#define PDSM_ONE_PLANE\n#define PDSM_GREY\n#define PDSM_ONE_LEVEL\n"
            "#define PDSM_PERSPECTIVE\n#define PDSM_ONE_VIEW\n");
  EXPECT_EQ(constants({&other}), "#define PDSM_ONLY_FORM 2u\n#define PDSM_GREY\n");
  EXPECT_EQ(constants({&plain, &other}), "#define PDSM_GREY\n");
  shape.channels = 3;
  const PenumbraMap colour = random_map(1, shape);
  EXPECT_EQ(constants({&plain, &colour}), "");
  EXPECT_EQ(constants({}), "");
}

/// What() of the refusal, or nothing.
std::string refusal(const std::vector<PenumbraMap>& maps, TextureLayout layout, const TextureLimits& limits) {
  try {
    static_cast<void>(make_map_textures(pointers(maps), layout, limits));
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource);
    return error.what();
  }
  return {};
}

TEST(MapTextures, LimitsAreToldNeverCut) {
  MapShape small, large;
  large.width = large.height = 80;
  const std::vector<PenumbraMap> maps{random_map(1, small), random_map(2, large)};
  for (const TextureLayout layout : kLayouts) {
    EXPECT_EQ(refusal(maps, layout, {4096}), "");
    const std::string told = refusal(maps, layout, {64});
    EXPECT_EQ(told.rfind("maps[1]: the set needs ", 0), 0U) << told;
    EXPECT_NE(told.find(layout == TextureLayout::two_level ? "a texture holds 4096" : "the limit is 64"),
              std::string::npos)
        << told;
  }
}

TEST(MapTextures, NumbersOfMapsAndViewsAreLimited) {
  const PenumbraMap one = one_texel_map({});
  std::vector<PenumbraMap> maps(kMaxShaderMaps, one);
  EXPECT_EQ(refusal(maps, TextureLayout::two_level, {}), "");
  maps.push_back(one);
  EXPECT_EQ(refusal(maps, TextureLayout::two_level, {}), "maps[64]: a set holds at most 64 maps");

  MapShape shape;
  shape.views = 6;
  EXPECT_EQ(refusal(std::vector<PenumbraMap>(16, random_map(1, shape)), TextureLayout::two_level, {}), "");
  EXPECT_EQ(refusal(std::vector<PenumbraMap>(17, random_map(1, shape)), TextureLayout::two_level, {}),
            "maps[16]: a set holds at most 96 views");
}

TEST(MapTextures, AWideIndexHoldsWhatOneWordCannot) {
  // 2^17 functions of 300 vertices, all different: 9 bits of count and 26 of address.
  PenumbraMap map = one_texel_map({});
  constexpr std::uint32_t kVertices = 300, kWidth = 2048, kHeight = 64;
  map.views[0].width = kWidth;
  map.views[0].height = kHeight;
  FunctionImage& image = map.images[0];
  image.width = kWidth;
  image.height = kHeight;
  image.blocks.clear();
  std::uint32_t number = 0;
  for (std::uint32_t bx = 0; bx < kWidth / kBlockSize; ++bx) {
    FunctionBlock block;
    for (std::uint32_t t = 0; t < kBlockSize * kBlockSize; ++t, ++number) {
      block.first.push_back(t * kVertices);
      // Depths 1 .. 300, the first two codes tell the function's number apart.
      for (std::uint32_t n = 0; n < kVertices; ++n) {
        const std::uint32_t value = n == 0   ? number & 255
                                    : n == 1 ? number >> 8 & 255
                                    : n == 2 ? number >> 16
                                             : 7;
        block.words.push_back((n + 1) | value << 16 | value << 24);
      }
    }
    block.first.push_back(kBlockSize * kBlockSize * kVertices);
    image.blocks.push_back(std::move(block));
  }
  const PenumbraMap* const maps[] = {&map};
  MapTextures textures = make_map_textures(maps, TextureLayout::two_level);
  ASSERT_EQ(textures.index.channels, 2U);
  set_look_up(textures.tables, 0, {Filter::nearest, 0});
  const PenumbraLookUp look_up(map);
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    // Texel centres, depth codes 1 .. 4.
    const double z = 1 + 1.5 + static_cast<double>(random.below(4));
    const double x = ((static_cast<double>(random.below(kWidth)) + 0.5) / kWidth * 2 - 1) * z;
    const double y = ((static_cast<double>(random.below(kHeight)) + 0.5) / kHeight * 2 - 1) * z;
    const FloatPoint p{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    ASSERT_EQ(mirror_attenuation(textures, 0, p),
              look_up.at({p[0], p[1], p[2]}, Filter::nearest).attenuation);
  }
}

}  // namespace
}  // namespace pdsm
