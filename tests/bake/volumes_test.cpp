// SPDX-License-Identifier: Apache-2.0
// Bakes of volumes against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pdsm/bake/map_key.h"
#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/merged_shards.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/volumes.h"
#include "trace/volume_steps.h"

namespace pdsm::test {
namespace {

constexpr double kEpsilon = 0.004;
constexpr std::uint32_t kSamples = 64;

BakeOptions volume_options(std::uint32_t edge = 32) {
  BakeOptions options = small_options(edge, edge, kSamples);
  options.epsilon = kEpsilon;
  options.depth_tolerance = 1e-4;
  options.bias = 0.01;
  options.receivers = Receivers::all;
  return options;
}

/// A point, so that all samples' rays are alike but for their jitter.
Light point_light() {
  Light light = rect_light(0, 0);
  set_view(light, 0.4, 0.4, 2, 8);
  return light;
}

Scene scene_of(std::vector<Volume> volumes) {
  Scene scene;
  scene.volumes = std::move(volumes);
  return scene;
}

/// Metres of a ray for a metre of depth, of the texel and of those beside it: what jitter and a map texel's
/// width may make of it.
struct Stretch {
  double least, middle, most;
  Stretch(const BakedFunctions& baked, std::uint32_t i, std::uint32_t j) {
    const double x = std::abs(baked.slope_x(i)), y = std::abs(baked.slope_y(j));
    const double dx = baked.map_pitch_x(), dy = baked.map_pitch_y();
    least = std::hypot(1, std::max(x - dx, 0.0), std::max(y - dy, 0.0));
    middle = std::hypot(1, x, y);
    most = std::hypot(1, x + dx, y + dy);
  }
};

/// What the march may be off at a slab's two sides, along which all rays look alike. One sample's optical
/// depth is off by up to e, a part's length at each side; over the samples that averages out to e / sqrt(N),
/// were their places among the parts random, and leaves e^2 / 2 in the mean of exp().
double march_error(double voxel_depth) {
  const double part = std::clamp(VolumeField::kPartDepth / voxel_depth, VolumeField::kShortestPart,
                                 VolumeField::kLongestPart);
  const double e = 2 * part * voxel_depth / 2;
  return e / std::sqrt(kSamples) + e * e / 2;
}

/// Holds a bake to 1 - exp(-depth(z, stretch)) where all samples see the same, and `voxel_depth` is a voxel's
/// greatest optical depth. `passed` is what else lets light through.
template <typename Depth>
void expect_taken(const BakedFunctions& baked, double voxel_depth, Depth&& depth, double passed = 1) {
  const double steps = choose_volume_steps(kEpsilon, kSamples);
  const double fit = kEpsilon + 0.5 / (kSamples * steps) + march_error(voxel_depth) + 1e-4;
  for (std::uint32_t j = 0; j < baked.view().height; j += 5) {
    for (std::uint32_t i = 0; i < baked.view().width; i += 5) {
      const Stretch stretch(baked, i, j);
      for (double z = 2.05; z < 7.95; z += 0.093) {
        const auto taken = [&](double s, double at) { return 1 - passed * std::exp(-depth(at, s)); };
        // Depths may be off by delta.
        ASSERT_GT(baked.value(i, j, z), taken(stretch.least, z - 1e-3) - fit) << i << ' ' << j << ' ' << z;
        ASSERT_LT(baked.value(i, j, z), taken(stretch.most, z + 1e-3) + fit) << i << ' ' << j << ' ' << z;
      }
    }
  }
}

TEST(Volumes, ASlabTakesAsItsClosedForm) {
  const Slab slab;
  for (const double extinction : {0.2, 1.0, 4.0}) {
    const BakedFunctions baked(scene_of({slab.volume(extinction)}), point_light(), volume_options());
    expect_taken(baked, extinction * slab.voxel,
                 [&](double z, double stretch) { return extinction * stretch * slab.integral(z); });
  }
}

/// By an area light: the mean over the map's own samples, by their closed forms.
TEST(Volumes, AnAreaLightSeesTheMeanOfItsSamples) {
  const Slab slab;
  Light light = rect_light(2, 2);
  set_view(light, 0.4, 0.4, 2, 8);
  const BakedFunctions baked(scene_of({slab.volume(1)}), light, volume_options());
  const double steps = choose_volume_steps(kEpsilon, kSamples);
  // Rays as unlike as independent ones would err by 1 / (m sqrt(6 N)) rms; four times that, for all texels.
  const double tolerance = kEpsilon + 4 / (steps * std::sqrt(6.0 * kSamples)) + march_error(slab.voxel) +
                           0.5 * baked.map_pitch_x();
  for (std::uint32_t j = 0; j < 32; j += 5) {
    for (std::uint32_t i = 0; i < 32; i += 5) {
      for (const double z : {3.5, 4.0, 5.0, 7.5}) {
        double mean = 0;
        for (const LightSample& s : baked.map().samples) {
          const double x = baked.slope_x(i) - s.position[0] / z, y = baked.slope_y(j) - s.position[1] / z;
          mean += std::exp(-std::hypot(1, x, y) * slab.integral(z)) / kSamples;
        }
        ASSERT_NEAR(baked.value(i, j, z), 1 - mean, tolerance) << i << ' ' << j << ' ' << z;
      }
    }
  }
}

TEST(Volumes, UnderTheSunRaysAreStraight) {
  const Slab slab;
  Light sun = distant_light(0);
  sun.window = {{-1, -1, 1, 1}};
  sun.near_depth = 2;
  sun.far_depth = 8;
  const BakedFunctions baked(scene_of({slab.volume(1)}), sun, volume_options());
  const double tolerance = kEpsilon + march_error(slab.voxel) + 1e-3;
  for (const double z : {2.5, 3.4, 4.0, 4.6, 6.0})
    EXPECT_NEAR(baked.value(7, 21, z), 1 - std::exp(-slab.integral(z)), tolerance) << z;
}

TEST(Volumes, ThatOverlapMultiply) {
  const Slab slab{3, 0.25, 7}, deeper{3.9, 0.2, 12};
  const BakedFunctions baked(scene_of({slab.volume(1), deeper.volume(0.5)}), point_light(), volume_options());
  expect_taken(baked, slab.voxel, [&](double z, double stretch) {
    return stretch * (slab.integral(z) + 0.5 * deeper.integral(z));
  });
}

TEST(Volumes, MultiplyWithPanesAndEndAtWhatIsOpaque) {
  const Slab slab;
  for (const double pane : {2.5, 4.0, 6.0}) {
    Scene scene = scene_of({slab.volume(1)});
    add(scene, Plate{-kWide, -kWide, kWide, kWide, pane}, Roles::caster);
    scene.geometry.back().opacity = 0.3;
    add(scene, Plate{-kWide, -kWide, kWide, kWide, 7}, Roles::caster);
    const BakedFunctions baked(scene, point_light(), volume_options());
    const double tolerance = kEpsilon + march_error(slab.voxel) + 0.02;
    for (const double z : {3.0, 3.5, 4.5, 5.5, 6.5}) {
      const Stretch stretch(baked, 16, 16);
      const double kept = (z > pane ? 0.7 : 1) * std::exp(-stretch.middle * slab.integral(z));
      EXPECT_NEAR(baked.value(16, 16, z), 1 - kept, tolerance) << pane << ' ' << z;
    }
    EXPECT_EQ(baked.value(16, 16, 7.5), 1);
  }
}

/// The same slab by another lattice, turned, and with other scales along its axes.
TEST(Volumes, ExtinctionIsPerMetreOfTheWorld) {
  const Slab slab;
  Volume turned;
  turned.name = "turned";
  turned.grid = make_grid({1, 0, 0}, {7, 7, 7}, [](int, int, int) { return 2; });
  // Lattice x goes along depth, y and z across.
  turned.index_to_world = glm::dmat4(glm::dvec4(0, 0, 0.25, 0), glm::dvec4(0, -200, 0, 0),
                                     glm::dvec4(150, 30, 0, 0), glm::dvec4(-500, 700, 3, 1));
  turned.extinction = 0.5;
  const BakedFunctions baked(scene_of({turned}), point_light(), volume_options());
  expect_taken(baked, slab.voxel, [&](double z, double stretch) { return stretch * slab.integral(z); });
}

TEST(Volumes, ThatHoldTheLightTakeFromTheStart) {
  Volume fog;
  fog.name = "fog";
  fog.grid = make_grid({0, 0, 0}, {15, 15, 15}, [](int, int, int) { return 1; });
  fog.index_to_world = scaled_and_moved({10, 10, 10}, {-75, -75, -75});
  fog.extinction = 0.2;
  const BakedFunctions baked(scene_of({fog}), point_light(), volume_options());
  expect_taken(baked, 2, [](double z, double stretch) { return 0.2 * stretch * z; });
}

TEST(Volumes, ThatTakeNothingLeaveTheSameBytes) {
  Scene scene;
  add(scene, Plate{-1, -1, 1, 0.5, 4});
  add(scene, Plate{-9, -9, 9, 9, 7});
  const Light light = rect_light(1, 1);
  const BakeOptions options = small_options(48, 48, 16);
  const BakedFunctions without(scene, light, options);
  Volume volume = Slab().volume(1);
  std::vector<Volume> idle{volume, volume, volume, volume};
  idle[0].casts = false;
  idle[1].extinction = 0;
  idle[2].grid = std::make_shared<DensityGrid>();
  idle[3].index_to_world[3].z = -900;
  scene.volumes = idle;
  const BakedFunctions with(scene, light, options);
  expect_same_bytes(with, without);
  EXPECT_EQ(with.report().key, without.report().key);
  EXPECT_EQ(with.view(), without.view());
}

/// A cloud over a floor, beside a plate and a pane.
Scene cloud_scene() {
  Scene scene;
  Random random(3);
  Volume cloud;
  cloud.name = "cloud";
  cloud.grid = make_grid({-9, -6, -5}, {11, 7, 9},
                         [&](int, int, int) { return std::max(0.0, random.uniform(-1, 2)); });
  cloud.index_to_world = scaled_and_moved({0.1, 0.12, 0.1}, {0.1, 0, 4});
  scene.volumes = {cloud};
  add(scene, Plate{-1, -1, 0, 0, 3});
  add(scene, Plate{-0.5, -0.5, 2, 2, 5});
  scene.geometry.back().opacity = 0.4;
  add(scene, Plate{-9, -9, 9, 9, 7});
  return scene;
}

TEST(Volumes, ThreadsTilesAndShardsChangeNoByte) {
  const Scene scene = cloud_scene();
  const Light light = rect_light(1, 1);
  BakeOptions options = small_options(150, 130, 8);
  options.threads = 1;
  options.mip_levels = 2;
  const BakedFunctions whole(scene, light, options);
  EXPECT_GT(greatest_value(whole), 0.5);
  for (const std::uint32_t threads : {2U, 3U}) {
    BakeOptions other = options;
    other.threads = threads;
    other.tile = 64 * (threads - 1);
    expect_same_bytes(BakedFunctions(scene, light, other), whole);
    const BakedMap merged =
        bake_in_shards(scene, light, other, 3, [](const BakedMap&) { return std::string("{}"); });
    for (std::size_t level = 0; level < merged.blocks.size(); ++level)
      for (std::size_t n = 0; n < merged.blocks[level].size(); ++n)
        EXPECT_TRUE(merged.blocks[level][n].bytes == whole.baked().blocks[level][n].bytes);
    const auto volumes = std::ranges::find(merged.report.modelled, "volumes", &ModelledFeature::feature);
    ASSERT_NE(volumes, merged.report.modelled.end());
    EXPECT_TRUE(volumes->modelled);
  }
}

TEST(Volumes, CellsThatTheyReachAreNotLeftOut) {
  // Looking at all rays, as samples out of the light's plane have it, finds no more.
  const Scene scene = cloud_scene();
  const Light light = rect_light(1, 1);
  BakeOptions options = small_options(96, 96, 16);
  const BakedFunctions some(scene, light, options);
  options.light_samples = some.map().samples;
  options.light_samples.front().position[2] = 1e-9;
  const BakedFunctions all(scene, light, options);
  // One float of the sample's place moves an event of it here and there.
  for (std::uint32_t j = 0; j < 96; j += 3)
    for (std::uint32_t i = 0; i < 96; i += 3)
      for (double z = some.view().near_depth; z < some.domain_end(i, j); z += 0.2)
        ASSERT_NEAR(some.value(i, j, z), all.value(i, j, z), 2 * options.epsilon + 1.0 / 16) << i << ' ' << j;
}

TEST(Volumes, ViewsAreFittedToThem) {
  Volume cloud = cloud_scene().volumes[0];
  Light light = rect_light(1, 1);
  // Nothing receives: the view is that of what casts. Lattice -9 .. 11 lies in cells -16 .. 16 along z.
  const FittedView alone = fit_view(scene_of({cloud}), light, 32, 32);
  EXPECT_FALSE(alone.nothing_casts);
  EXPECT_NEAR(alone.view.near_depth, 4 - 0.8, 1e-4);
  EXPECT_NEAR(alone.view.far_depth, 4 + 1.6, 1e-4);
  Scene above = scene_of({cloud});
  add(above, Plate{-9, -9, 9, 9, 7}, Roles::receiver);
  const FittedView fitted = fit_view(above, light, 32, 32);
  EXPECT_NEAR(fitted.view.near_depth, 4 - 0.8, 1e-4);
  EXPECT_NEAR(fitted.view.far_depth, 7, 1e-4);
  EXPECT_LT(fitted.view.window[2], 9.0 / 7);
  Light sun = distant_light(5);
  place_distant_light(above, sun);
  EXPECT_NEAR(sun.position.z, 3.2 - std::hypot(18, 18, 7 - 3.2) / 16, 1e-6);
}

TEST(Volumes, KeysTellThemApart) {
  const Light light = rect_light(1, 1);
  const BakeOptions options = small_options(64, 64, 4);
  Scene scene = cloud_scene();
  const auto key = [&] { return map_key(scene, light, options).key; };
  const std::string before = key();
  EXPECT_EQ(key(), before);
  scene.volumes[0].extinction = 1.5;
  EXPECT_NE(key(), before);
  scene = cloud_scene();
  scene.volumes[0].index_to_world[3].x += 1e-3;
  EXPECT_NE(key(), before);
  scene = cloud_scene();
  auto grid = std::make_shared<DensityGrid>(*scene.volumes[0].grid);
  grid->bricks[0].density[511] += 0.25F;
  scene.volumes[0].grid = grid;
  EXPECT_NE(key(), before);
}

TEST(Volumes, BlocksInTheirReachHaveNoKeys) {
  Scene scene;
  add(scene, Plate{-0.2, -0.2, 0.2, 0.2, 4}, Roles::caster);
  add(scene, Plate{-9, -9, 9, 9, 7}, Roles::receiver);
  Light light = rect_light(0.1, 0.1);
  set_view(light, 1, 1, 2, 7.1);
  BakeOptions options = small_options(128, 128, 4);
  options.block_keys = true;
  const auto known_keys = [&] {
    const std::vector<BlockKey> keys = BakedFunctions(scene, light, options).map().block_keys;
    return std::ranges::count_if(keys, &BlockKey::is_known);
  };
  EXPECT_EQ(known_keys(), 4);
  Volume puff = cloud_scene().volumes[0];
  puff.index_to_world = scaled_and_moved({0.05, 0.05, 0.05}, {2.5, 2.5, 4});
  scene.volumes = {puff};
  EXPECT_EQ(known_keys(), 3);
}

TEST(Volumes, FaultsNameTheVolume) {
  const auto fault = [](const Volume& volume, double epsilon = 0.01) -> std::string {
    BakeOptions options = small_options(16, 16, 2);
    options.epsilon = epsilon;
    try {
      static_cast<void>(bake(scene_of({volume}), point_light(), options));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const Volume good = Slab().volume(1);
  EXPECT_EQ(fault(good), "");
  EXPECT_EQ(fault(good, 0).substr(0, 20), "--epsilon: too small");
  Volume bad = good;
  bad.extinction = -1;
  EXPECT_EQ(fault(bad), "slab:extinction: must be a number >= 0");
  bad = good;
  bad.index_to_world[1] = glm::dvec4(0);
  EXPECT_EQ(fault(bad), "slab:index_to_world: must be affine, finite and not singular");
  bad = good;
  bad.grid = nullptr;
  EXPECT_EQ(fault(bad), "slab:grid: is missing");
  for (const auto& [density, first] : {std::pair{-1.0F, 0}, {NAN, 0}, {1.0F, 4}}) {
    auto grid = std::make_shared<DensityGrid>(*good.grid);
    grid->bricks[0].density[9] = density;
    grid->bricks[0].first.x += first;
    bad.grid = grid;
    EXPECT_EQ(fault(bad),
              first == 0 ? "slab:grid: has densities that are negative, infinite or NaN"
                         : "slab:grid: has a brick off the lattice of bricks, or more than 2^22 voxels out");
  }
  auto twice = std::make_shared<DensityGrid>(*good.grid);
  twice->bricks.push_back(twice->bricks.back());
  bad.grid = twice;
  EXPECT_EQ(fault(bad), "slab:grid: has bricks out of order, or one twice");
}

/// Optical depths beyond what exp() can hold are umbra.
TEST(Volumes, OpticalDepthMayOverflow) {
  Volume wall = Slab().volume(1e12);
  auto grid = std::make_shared<DensityGrid>(*wall.grid);
  for (DensityBrick& brick : grid->bricks)
    for (float& density : brick.density) density *= 1e38F;
  wall.grid = grid;
  const BakedFunctions baked(scene_of({wall}), point_light(), volume_options(16));
  EXPECT_EQ(baked.value(8, 8, 2.9), 0);
  EXPECT_EQ(baked.value(8, 8, 5), 1);
}

}  // namespace
}  // namespace pdsm::test
