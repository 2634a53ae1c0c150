// SPDX-License-Identifier: Apache-2.0
// The same bytes, of all mip levels, for any number of threads, any tiling, any memory, and any order of
// samples and triangles.
#include <gtest/gtest.h>

#include <algorithm>

#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

/// Plates, a sphere and a floor.
Scene mixed_scene() {
  Scene scene;
  Random random(51);
  for (int n = 0; n < 6; ++n) {
    const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    add(scene,
        Plate{x, y, x + random.uniform(0.2, 1.5), y + random.uniform(0.2, 1.5), random.uniform(2.5, 6)});
  }
  add(scene, sphere_mesh({0.3, -0.4, 4}, 0.7, 4));
  add(scene, Plate{-9, -9, 9, 9, 8});
  return scene;
}

/// 3 x 3 blocks, the outer ones cut; maps as fine as the PDSM, finer and coarser.
struct Grid {
  std::uint32_t width, height, map_width, map_height;
};
constexpr Grid kGrids[] = {{150, 130, 150, 130}, {150, 130, 300, 390}, {160, 132, 40, 66}};

BakeOptions options_for(const Grid& grid) {
  BakeOptions options = small_options(grid.width, grid.height, 24);
  options.map_width = grid.map_width;
  options.map_height = grid.map_height;
  options.threads = 2;
  options.mip_levels = 6;
  return options;
}

Light key_light() {
  Light light = rect_light(1.5, 1);
  light.window = {-0.5, -0.4, 0.5, 0.4};
  return light;
}

class Repeatable : public testing::TestWithParam<Grid> {
 protected:
  BakedFunctions first_{mixed_scene(), key_light(), options_for(GetParam())};
};

TEST_P(Repeatable, ForAnyNumberOfThreads) {
  EXPECT_GT(first_.vertex_count(), 1000u);
  for (const std::uint32_t threads : {1u, 2u, 3u, 8u}) {
    SCOPED_TRACE(threads);
    BakeOptions options = options_for(GetParam());
    options.threads = threads;
    expect_same_bytes(first_, {mixed_scene(), key_light(), options});
  }
}

TEST_P(Repeatable, ForAnyTile) {
  for (const std::uint32_t tile : {64u, 128u, 0u}) {
    SCOPED_TRACE(tile);
    BakeOptions options = options_for(GetParam());
    options.tile = tile;
    const BakedFunctions baked(mixed_scene(), key_light(), options);
    expect_same_bytes(first_, baked);
    EXPECT_EQ(baked.report().tiles, tile == 64 ? 9u : tile == 128 ? 4u : first_.report().tiles);
  }
}

/// So little memory that tiles are split while they are baked.
TEST_P(Repeatable, WithLittleMemory) {
  BakeOptions options = options_for(GetParam());
  options.threads = 1;
  options.tile = 192;
  const BakedFunctions whole(mixed_scene(), key_light(), options);
  ASSERT_EQ(whole.report().tiles, 1u);
  // From what a bake takes without splitting down to what is too little even for one block.
  std::uint64_t most_tiles = 0;
  double memory = static_cast<double>(whole.report().peak_event_bytes + (std::uint64_t{16} << 20));
  try {
    for (; most_tiles < 4; memory *= 0.9) {
      options.memory = static_cast<std::uint64_t>(memory);
      const BakedFunctions baked(mixed_scene(), key_light(), options);
      most_tiles = std::max(most_tiles, baked.report().tiles);
      if (baked.report().tiles > 1) expect_same_bytes(whole, baked);
    }
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource) << error.what();
  }
  EXPECT_GT(most_tiles, 1u) << "some memory must have split the tile";
}

TEST_P(Repeatable, ForAnyOrderOfSamples) {
  BakeOptions options = options_for(GetParam());
  options.light_samples = make_light_samples(key_light(), options.samples, PointSet::lattice, 0);
  expect_same_bytes(first_, {mixed_scene(), key_light(), options});
  Random random(52);
  for (int n = 0; n < 3; ++n) {
    random.shuffle(options.light_samples);
    expect_same_bytes(first_, {mixed_scene(), key_light(), options});
  }
}

TEST_P(Repeatable, ForAnyOrderOfTriangles) {
  Random random(53);
  for (int n = 0; n < 3; ++n) {
    Scene scene = mixed_scene();
    random.shuffle(scene.geometry);
    for (Geometry& geometry : scene.geometry) {
      Mesh mesh = *geometry.mesh;
      random.shuffle(mesh.triangles);
      geometry.mesh = std::make_shared<const Mesh>(std::move(mesh));
    }
    expect_same_bytes(first_, {scene, key_light(), options_for(GetParam())});
  }
}

/// What is far beside all maps does not decide how these are made.
TEST_P(Repeatable, WhateverLiesFarBeside) {
  Scene scene = mixed_scene();
  add(scene, Plate{3000, -1, 1e6, 1, 4});
  expect_same_bytes(first_, {scene, key_light(), options_for(GetParam())});
}

TEST_P(Repeatable, ASeedSelectsItsOwnSamples) {
  BakeOptions options = options_for(GetParam());
  options.seed = 7;
  const BakedFunctions a(mixed_scene(), key_light(), options), b(mixed_scene(), key_light(), options);
  expect_same_bytes(a, b);
  bool differs = false;
  for (std::size_t n = 0; n < a.baked().blocks[0].size(); ++n) {
    differs = differs || a.baked().blocks[0][n].bytes != first_.baked().blocks[0][n].bytes;
  }
  EXPECT_TRUE(differs);
}

/// Samples out of the light's plane, which take another path through the tile.
TEST(RepeatableTilted, ForAnyThreadsTileAndOrder) {
  BakeOptions options = options_for(kGrids[0]);
  options.light_samples = make_light_samples(key_light(), 12, PointSet::jittered, 3);
  Random random(54);
  for (LightSample& sample : options.light_samples) sample.position[2] = random.uniform(-0.5, 0.5);
  const BakedFunctions first(mixed_scene(), key_light(), options);
  options.threads = 3;
  options.tile = 64;
  random.shuffle(options.light_samples);
  expect_same_bytes(first, {mixed_scene(), key_light(), options});
}

INSTANTIATE_TEST_SUITE_P(EveryGrid, Repeatable, testing::ValuesIn(kGrids), [](const auto& grid) {
  return "Maps" + std::to_string(grid.param.map_width) + "x" + std::to_string(grid.param.map_height);
});

/// What the metadata tell that was saved. A slanted floor darkens no ray, as all end on it: that is found out
/// for casters over many cells, and the last block has two.
TEST(RepeatableCounts, TilesSaveTheSame) {
  Scene scene;
  add(scene, quad_mesh({-9, -9, 6}, {9, -9, 9}, {9, 9, 9}, {-9, 9, 6}));
  add(scene, Plate{-1.5, -1.2, -1, -0.8, 4});
  BakeOptions options = options_for(kGrids[0]);
  std::vector<ModelledFeature> of_tiles[2];
  for (const std::uint32_t tile : {64u, 192u}) {
    options.tile = tile;
    of_tiles[tile / 192] = BakedFunctions(scene, key_light(), options).report().modelled;
  }
  ASSERT_EQ(of_tiles[0].size(), of_tiles[1].size());
  for (std::size_t n = 0; n < of_tiles[0].size(); ++n)
    EXPECT_EQ(of_tiles[0][n].saved, of_tiles[1][n].saved) << of_tiles[0][n].feature;
}

}  // namespace
}  // namespace pdsm::test
