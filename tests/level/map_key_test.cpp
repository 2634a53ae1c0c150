// SPDX-License-Identifier: Apache-2.0
// With equal keys, maps are the same bytes, metadata included; what the light does not see leaves the key.
#include "pdsm/bake/map_key.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <set>

#include "cli/bake_record.h"
#include "pdsm/format/map_file.h"
#include "support/random.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

BakeOptions quick_options() {
  BakeOptions options;
  options.samples = 8;
  options.width = options.height = 24;
  options.threads = 1;
  return options;
}

std::vector<std::byte> bake_file(const Scene& scene, const Light& light, const BakeOptions& options) {
  const BakedMap baked = bake(scene, light, options);
  PenumbraMap map = decode_blocks(baked);
  map.metadata = bake_metadata(light, options, baked);
  return serialize_map(map);
}

/// A level as the light at the origin sees it: a floor at depth 8, a few boxes over it, one of them to be
/// moved.
struct Level {
  glm::dvec3 moved{0.5, 0.3, 5};

  [[nodiscard]] Scene scene() const {
    Scene scene;
    add(scene, Plate{-30, -30, 30, 30, 8});
    add(scene, box_mesh({-1, -1, 4}, {-0.2, 0.4, 4.5}));
    add(scene, box_mesh({1.2, -2, 6}, {2, -1, 7}));
    // Two faces of equal depth, of which either may be met first.
    add(scene, box_mesh({-2, 1, 5}, {-1, 2, 6}));
    add(scene, box_mesh({-1, 1, 5}, {0, 2, 6}));
    add(scene, box_mesh(moved - 0.3, moved + 0.3));
    return scene;
  }
};

struct NamedLight {
  const char* name;
  Light light;
};

NamedLight open_view() {
  return {"Fitted", rect_light(1, 0.6)};
}
NamedLight given_view() {
  Light light = rect_light(1, 0.6);
  set_view(light, 0.5, 0.5, 2, 8.5);
  return {"Given", light};
}
NamedLight given_window() {
  Light light = disk_light(0.4);
  light.window = {-0.3, -0.5, 0.5, 0.5};
  return {"Window", light};
}
NamedLight sun() {
  Light light = distant_light(3);
  light.window = {-3, -3, 3, 3};
  return {"Sun", light};
}

class EveryLight : public testing::TestWithParam<NamedLight> {};

/// Steps of all sizes: some within the hull, some out of it, some from one place outside to another.
TEST_P(EveryLight, EqualKeysAreEqualBytes) {
  Random random(611);
  const BakeOptions options = quick_options();
  const Light& light = GetParam().light;
  Level level;
  std::string key = map_key(level.scene(), light, options).key;
  std::vector<std::byte> bytes = bake_file(level.scene(), light, options);
  int equal = 0, other = 0;
  for (int n = 0; n < 60; ++n) {
    const double reach = n % 3 == 0 ? 1.0 : 12.0;
    level.moved = {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(1, 7.5)};
    // Of the scene's front, where a sun's space begins.
    if (is_distant(light)) level.moved.z = random.uniform(2, 7.5);
    SCOPED_TRACE(testing::Message() << "step " << n << " to " << level.moved.x << ' ' << level.moved.y << ' '
                                    << level.moved.z);
    const std::string next_key = map_key(level.scene(), light, options).key;
    std::vector<std::byte> next_bytes = bake_file(level.scene(), light, options);
    EXPECT_TRUE(next_key != key || next_bytes == bytes);
    (next_key == key ? equal : other) += 1;
    key = next_key;
    bytes = std::move(next_bytes);
  }
  EXPECT_GE(equal, 5);
  EXPECT_GE(other, 5);
}

/// At depth 5 the hull reaches to 2.5 + 0.5 (1 - 5 / 8.5) = 2.7 m, and 8 texels of 1/24 make that 4.4 m.
TEST(MapKey, WhatLiesBesideTheHullIsNoPartOfIt) {
  const Light light = given_view().light;
  Level level;
  level.moved = {6, 0, 5};
  const std::string beside = map_key(level.scene(), light, quick_options()).key;
  level.moved = {-9, 3, 7};
  EXPECT_EQ(map_key(level.scene(), light, quick_options()).key, beside);
  level.moved = {0, 0, -3};
  EXPECT_EQ(map_key(level.scene(), light, quick_options()).key, beside) << "behind the light";
  level.moved = {0, 0, 9.5};
  EXPECT_EQ(map_key(level.scene(), light, quick_options()).key, beside) << "behind far";
  level.moved = {2, 0, 5};
  EXPECT_NE(map_key(level.scene(), light, quick_options()).key, beside) << "within";
}

TEST(MapKey, TellsEverythingThatChangesTheBytes) {
  const Light light = given_view().light;
  const Scene scene = Level().scene();
  std::vector<BakeOptions> options(16, quick_options());
  std::size_t n = 0;
  options[++n].samples = 9;
  options[++n].width = 25;
  options[++n].height = 25;
  options[++n].map_width = 48;
  options[++n].map_height = 48;
  options[++n].epsilon = 0.03;
  options[++n].depth_tolerance = 0.5;
  options[++n].bias = 0.5;
  options[++n].walk = Walk::midpoint;
  options[++n].receivers = Receivers::all;
  options[++n].points = PointSet::jittered;
  options[++n].mip_levels = 2;
  options[++n].seed = 1;
  options[++n].unrounded_values = true;
  options[++n].isa = "another";
  ASSERT_EQ(n + 1, options.size());
  std::set<std::string> keys;
  for (const BakeOptions& each : options) keys.insert(map_key(scene, light, each).key);
  EXPECT_EQ(keys.size(), options.size());
  keys.insert(map_key(scene, light, quick_options(), "another version").key);

  std::vector<Light> lights(6, light);
  lights[0].name = "other";
  lights[1].shape = RectLight{1, 0.7};
  lights[2].shape = DiskLight{0.5};
  lights[3].position.x = 0.01;
  lights[4].up = glm::dvec3(1, 1, 0);
  lights[5].far_depth = 8.6;
  for (const Light& each : lights) keys.insert(map_key(scene, each, quick_options()).key);
  Scene open = scene;
  open.geometry[1].casts = false;
  keys.insert(map_key(open, light, quick_options()).key);
  open.geometry[1].casts = true;
  open.geometry[1].receives = false;
  keys.insert(map_key(open, light, quick_options()).key);
  EXPECT_EQ(keys.size(), options.size() + 1 + lights.size() + 2);
}

TEST(MapKey, DoesNotTellWhatLeavesTheBytes) {
  const Light light = given_view().light;
  const Scene scene = Level().scene();
  const BakedMap baked = bake(scene, light, quick_options());
  const std::string key = map_key(scene, light, quick_options()).key;
  EXPECT_EQ(baked.report.key, key);
  BakeOptions options = quick_options();
  options.threads = 2;
  options.memory = std::uint64_t{1} << 30;
  options.tile = 64;
  options.isa = baked.report.isa;
  // Asked for what would have been taken.
  options.bias = baked.report.bias;
  options.depth_tolerance = baked.report.depth_tolerance;
  options.map_width = options.map_height = 24;
  EXPECT_EQ(map_key(scene, light, options).key, key);
}

TEST(MapKey, IsReadFromAFile) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  std::string name = (folder / "pdsm_key_XXXXXX").string();
  const int file = mkstemp(name.data());
  ASSERT_GE(file, 0);
  close(file);
  EXPECT_EQ(recorded_key(name), std::nullopt) << "of an empty file";
  const Light light = given_view().light;
  const BakedMap baked = bake(Level().scene(), light, quick_options());
  PenumbraMap map = decode_blocks(baked);
  map.metadata = bake_metadata(light, quick_options(), baked);
  write_map(map, name);
  EXPECT_EQ(recorded_key(name), baked.report.key);
  for (const char* metadata : {"{}", "{\"key\": 1}", "{\"light\": {\"key\": \"a\"}}", "{not JSON}"}) {
    map.metadata = metadata;
    write_map(map, name);
    EXPECT_EQ(recorded_key(name), std::nullopt) << metadata;
  }
  std::filesystem::remove(name);
}

INSTANTIATE_TEST_SUITE_P(MapKey, EveryLight,
                         testing::Values(open_view(), given_view(), given_window(), sun()),
                         [](const auto& light) { return light.param.name; });

}  // namespace
}  // namespace pdsm::test
