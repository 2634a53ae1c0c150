// SPDX-License-Identifier: Apache-2.0
// Bakes that take over what has not changed give the bytes of a bake of all, whatever has changed and
// whatever the map of before is.
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "file_bytes.h"
#include "pdsm/bake/shard.h"
#include "support/bake_file.h"
#include "support/baked_functions.h"
#include "support/checkpoint_case.h"
#include "support/cutouts.h"
#include "support/random.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

using pdsm::testing::Bytes;
using pdsm::testing::file_content;
using pdsm::testing::find_chunk;
using pdsm::testing::put_file;
using pdsm::testing::ScratchFolder;

struct Piece {
  Mesh mesh;
  Roles roles = Roles::both;
};
using Pieces = std::vector<Piece>;

Scene scene_of(const Pieces& pieces) {
  Scene scene;
  for (const Piece& piece : pieces) add(scene, piece.mesh, piece.roles);
  return scene;
}

/// A rectangle that is hardly tilted, so that no slope is limited.
Mesh random_leaf(Random& random) {
  const double x = random.uniform(-4, 4), y = random.uniform(-4, 4), z = random.uniform(2, 7);
  const double w = random.uniform(0.02, 0.8), h = random.uniform(0.02, 0.8), tilt = random.uniform(-0.1, 0.1);
  return quad_mesh({x, y, z}, {x + w, y, z + tilt * w}, {x + w, y + h, z}, {x, y + h, z - tilt * w});
}

Pieces random_pieces(Random& random) {
  Pieces pieces{{plate_mesh({-9, -9, 9, 9, 8}), random.pick({Roles::both, Roles::receiver})}};
  for (std::uint32_t n = random.count(1, 12); n > 0; --n)
    pieces.push_back(
        {random_leaf(random), random.pick({Roles::both, Roles::both, Roles::caster, Roles::receiver})});
  if (random.chance(0.2)) {
    const double x = random.uniform(-3, 2), y = random.uniform(-3, 2);
    pieces.push_back({cut_plate({x, y, x + 0.7, y + 0.5, random.uniform(3, 7)}, leaf_mask()), Roles::both});
  }
  // Steep sides right before the floor.
  if (random.chance(0.3)) {
    const double x = random.uniform(-4, 3), y = random.uniform(-4, 3);
    pieces.push_back({box_mesh({x, y, 6}, {x + 1, y + 1.5, 7.9}), Roles::both});
  }
  return pieces;
}

/// Moves, removes, adds or reshapes something small.
Pieces changed(Pieces pieces, Random& random) {
  Piece& piece =
      pieces[static_cast<std::size_t>(random.integer(1, static_cast<std::int64_t>(pieces.size()) - 1))];
  switch (random.integer(0, 6)) {
    case 0:
      for (glm::vec3& p : piece.mesh.positions) p.x += 0.3F;
      break;
    case 1:
      piece.mesh.positions[0].z += 0.01F;
      break;
    case 2:
      piece.mesh.triangles.pop_back();
      break;
    case 3:
      pieces.push_back({random_leaf(random), Roles::both});
      break;
    case 4:
      std::swap(piece.mesh.triangles[0], piece.mesh.triangles[1]);
      break;
    case 5:
      piece.roles = Roles::receiver;
      break;
    default:
      piece = {random_leaf(random), piece.roles};
  }
  return pieces;
}

Light random_light(Random& random) {
  Light light = random.chance(0.5) ? rect_light(random.uniform(0, 1.5), random.uniform(0, 1.5))
                                   : disk_light(random.uniform(0.05, 0.8));
  light.window = {-0.6, -0.55, 0.5, 0.6};
  if (random.chance(0.7)) light.near_depth = random.uniform(1.5, 3);
  if (random.chance(0.7)) light.far_depth = random.uniform(7, 9);
  return light;
}

BakeOptions random_options(Random& random) {
  BakeOptions options = small_options(random.count(150, 270), random.count(150, 270), random.count(1, 6));
  options.map_width = options.width * random.pick({1U, 1U, 2U});
  options.map_height = random.chance(0.3) ? options.height / 2 : options.height;
  options.walk = random.pick({Walk::midpoint, Walk::exact});
  options.receivers =
      random.pick({Receivers::all, Receivers::volume, Receivers::volume, Receivers::surfaces});
  options.points = random.pick({PointSet::lattice, PointSet::jittered});
  options.epsilon = random.pick({0.0, 0.02, 0.1});
  options.mip_levels = random.pick({0U, 2U, 6U});
  options.block_keys = true;
  return options;
}

class PreviousMap : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path before() const { return folder_.path() / "before.pdsm"; }
  /// Bakes twice, with and without the map of before; the files must be the same. Returns the former.
  BakedMap expect_same(const Scene& scene, const Light& light, BakeOptions options) const {
    const BakedMap whole = bake(scene, light, options);
    options.previous = before();
    BakedMap again = bake(scene, light, options);
    expect_same_bake(again, whole);
    EXPECT_TRUE(file_of(again, folder_.path() / "again") == file_of(whole, folder_.path() / "whole"));
    return again;
  }

  ScratchFolder folder_;
};

TEST_F(PreviousMap, RandomChangesGiveTheBytesOfABakeOfAll) {
  std::uint64_t partly = 0, blocks = 0, taken = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 500);
    const Light light = random_light(random);
    const BakeOptions options = random_options(random);
    const Pieces pieces = random_pieces(random);
    (void)file_of(bake(scene_of(pieces), light, options), before());
    BakeOptions other = options;
    other.threads = random.count(1, 3);
    other.tile = random.pick({0U, 64U, 128U});
    const BakeReport report = expect_same(scene_of(changed(pieces, random)), light, other).report;
    blocks += report.blocks;
    taken += report.blocks_taken_over;
    partly += report.blocks_taken_over > 0 && report.blocks_taken_over < report.blocks ? 1 : 0;
  }
  // Else the test would say nothing.
  EXPECT_GT(partly, 30U);
  EXPECT_GT(taken, blocks / 3);
}

/// A map of 4 x 4 blocks over tangents of -1 .. 1: a block is half a tangent. Receivers are at depth 8.
class FourByFour : public PreviousMap {
 protected:
  static Light light(double width) {
    Light light = rect_light(width, width);
    set_view(light, 1, 1, 2, 8);
    return light;
  }
  static BakeOptions options() {
    BakeOptions options = small_options(256, 256, 5);
    options.block_keys = true;
    return options;
  }
  /// A plate of 0.1 x 0.1 tangents about (u, v), as seen from the light's centre, at depth 4.
  static Mesh plate_at(double u, double v) {
    return plate_mesh({4 * u - 0.2, 4 * v - 0.2, 4 * u + 0.2, 4 * v + 0.2, 4});
  }
  static Pieces with_plate(double u, double v) {
    return {{plate_mesh({-20, -20, 20, 20, 8}), Roles::both}, {plate_at(u, v), Roles::caster}};
  }
  std::uint64_t taken_over(const Pieces& from, const Pieces& to, const Light& by,
                           const BakeOptions& how = options()) const {
    (void)file_of(bake(scene_of(from), by, how), before());
    return expect_same(scene_of(to), by, how).report.blocks_taken_over;
  }
};

TEST_F(FourByFour, APointLightsChangeIsWhereTheCasterIsSeen) {
  EXPECT_EQ(taken_over(with_plate(-0.75, -0.75), with_plate(-0.7, -0.75), light(0)), 15U) << "within a block";
  EXPECT_EQ(taken_over(with_plate(-0.75, -0.75), with_plate(0.25, 0.25), light(0)), 14U) << "to another";
  EXPECT_EQ(taken_over(with_plate(0, -0.75), with_plate(0.01, -0.75), light(0)), 14U) << "on a border";
  EXPECT_EQ(taken_over(with_plate(0, 0), with_plate(0.01, 0), light(0)), 12U) << "on a corner";
  EXPECT_EQ(taken_over(with_plate(0, 0), with_plate(0, 0), light(0)), 16U) << "not at all";
}

/// Samples w apart are seen past the plate at up to w/2 (1/4 - 1/8) = w/16 tangents beside it, so that the
/// shadow of a plate about 0.25, 0.05 to either side, stays in its block, 0 .. 0.5, while w < 3.2 less the
/// texels of a walk, which are 1/128 tangents each; and 0.01 that it moves.
TEST_F(FourByFour, AWiderLightsChangeReachesFarther) {
  for (const double w : {2.6, 3.3}) {
    BakeOptions corners = options();
    for (const double x : {-w / 2, w / 2})
      for (const double y : {-w / 2, w / 2}) corners.light_samples.push_back({{x, y, 0}});
    const std::uint64_t taken = taken_over(with_plate(0.25, 0.25), with_plate(0.24, 0.25), light(w), corners);
    EXPECT_EQ(taken, w < 3 ? 15U : 7U) << w;
  }
}

/// Over -0.45 .. -0.05 tangents in x and y, in block (1, 1) alone, the last receiver is not the floor but
/// behind it.
TEST_F(FourByFour, AReceiversChangeIsWhereFunctionsEnd) {
  const Pieces floor{{plate_mesh({-20, -20, 20, 20, 7}), Roles::both}, {plate_at(0.75, 0.75), Roles::caster}};
  Pieces from = floor, to = floor;
  from.push_back({plate_mesh({-3.375, -3.375, -0.375, -0.375, 7.5}), Roles::receiver});
  to.push_back({plate_mesh({-3.51, -3.51, -0.39, -0.39, 7.8}), Roles::receiver});
  EXPECT_EQ(taken_over(from, to, light(1)), 15U);
  EXPECT_EQ(taken_over(from, floor, light(1)), 15U);
}

/// The order of casters decides between equal depths, so that another order is another block.
TEST_F(FourByFour, TheOrderOfCastersCounts) {
  Pieces from = with_plate(-0.75, -0.75);
  from.push_back({plate_at(-0.74, -0.75), Roles::caster});
  Pieces to = from;
  std::swap(to[1], to[2]);
  EXPECT_EQ(taken_over(from, to, light(0)), 15U);
}

TEST_F(FourByFour, OtherOptionsTakeNothingOver) {
  const Scene scene = scene_of(with_plate(-0.75, -0.75));
  (void)file_of(bake(scene, light(1), options()), before());
  const std::vector<std::function<void(BakeOptions&)>> changes{
      [](BakeOptions& o) { o.samples = 6; },
      [](BakeOptions& o) { o.epsilon = 0.03; },
      [](BakeOptions& o) { o.depth_tolerance = 0.01; },
      [](BakeOptions& o) { o.bias = 0.02; },
      [](BakeOptions& o) { o.walk = Walk::midpoint; },
      [](BakeOptions& o) { o.receivers = Receivers::all; },
      [](BakeOptions& o) { o.points = PointSet::jittered; },
      [](BakeOptions& o) { o.seed = 1; },
      [](BakeOptions& o) { o.mip_levels = 1; },
      [](BakeOptions& o) { o.map_width = 512; },
      [](BakeOptions& o) { o.width = 255; },
      [](BakeOptions& o) { o.unrounded_values = true; },
      [](BakeOptions& o) { o.light_samples = {LightSample{}}; }};
  for (std::size_t n = 0; n < changes.size(); ++n) {
    SCOPED_TRACE(n);
    BakeOptions other = options();
    changes[n](other);
    EXPECT_EQ(expect_same(scene, light(1), other).report.blocks_taken_over, 0U);
  }
  EXPECT_EQ(expect_same(scene, light(1.01), options()).report.blocks_taken_over, 0U);
  Light farther = light(1);
  farther.far_depth = 8.5;
  EXPECT_EQ(expect_same(scene, farther, options()).report.blocks_taken_over, 0U);
}

TEST_F(FourByFour, ThreadsTilesAndMemoryHaveNoSay) {
  const Scene scene = scene_of(with_plate(-0.75, -0.75));
  (void)file_of(bake(scene, light(1), options()), before());
  BakeOptions other = options();
  other.threads = 3;
  other.tile = 64;
  other.memory /= 2;
  EXPECT_EQ(expect_same(scene, light(1), other).report.blocks_taken_over, 16U);
}

/// Samples that are traced depend on more than can be told.
TEST_F(FourByFour, WhatIsTracedHasNoKeys) {
  const Scene plates = scene_of(with_plate(-0.75, -0.75));
  EXPECT_EQ(bake(plates, light(1), options()).map.block_keys.size(), 16U);
  Light sun = distant_light(2);
  sun.window = {-8, -8, 8, 8};
  EXPECT_TRUE(bake(plates, sun, options()).map.block_keys.empty());
  BakeOptions out_of_plane = options();
  out_of_plane.light_samples = {LightSample{{0, 0, 0.5}}};
  EXPECT_TRUE(bake(plates, light(1), out_of_plane).map.block_keys.empty());
  BakeOptions without = options();
  without.block_keys = false;
  EXPECT_TRUE(bake(plates, light(1), without).map.block_keys.empty());
}

/// The leaf is seen as with_plate() has it, and through it rays are traced: block (2, 2) has all of its
/// shadow.
TEST_F(FourByFour, CutoutsLoseTheBlocksInTheirReachAlone) {
  Pieces from = with_plate(-0.75, -0.75), to = with_plate(-0.74, -0.75);
  for (Pieces* pieces : {&from, &to})
    pieces->push_back({cut_plate({0.8, 0.8, 1.2, 1.2, 4}, leaf_mask()), Roles::caster});
  const BakedMap baked = bake(scene_of(from), light(1), options());
  ASSERT_EQ(baked.map.block_keys.size(), 16U);
  for (std::size_t b = 0; b < 16; ++b) EXPECT_EQ(baked.map.block_keys[b].is_known(), b != 10) << b;
  EXPECT_EQ(taken_over(from, to, light(1)), 14U);
}

/// Under a light 1 wide the box is seen and darkens from 1.2 / 7.9 - 0.02 to 2.4 / 6 + 0.02 tangents: in
/// block (2, 2). Its sides, seen nearly edge-on, have the floor close behind them, so that their slopes are
/// limited by rays.
TEST_F(FourByFour, LimitedSlopesLoseTheBlocksOfTheirCastersAlone) {
  Pieces from = with_plate(-0.75, -0.75), to = with_plate(-0.74, -0.75);
  for (Pieces* pieces : {&from, &to})
    pieces->push_back({box_mesh({1.2, 1.2, 6}, {2.4, 2.4, 7.9}), Roles::both});
  const BakedMap baked = bake(scene_of(from), light(1), options());
  ASSERT_EQ(baked.map.block_keys.size(), 16U);
  for (std::size_t b = 0; b < 16; ++b) EXPECT_EQ(baked.map.block_keys[b].is_known(), b != 10) << b;
  EXPECT_EQ(taken_over(from, to, light(1)), 14U);
}

/// Two maps of one bake and a small change: the first is the map of before.
class UntrustedMap : public FourByFour {
 protected:
  UntrustedMap() {
    deep_.mip_levels = 2;
    const Scene from = scene_of(with_plate(-0.75, -0.75));
    scene_ = scene_of(with_plate(-0.74, -0.75));
    good_ = file_of(bake(from, light(1), deep_), before());
    whole_ = bake(scene_, light(1), deep_);
    whole_bytes_ = file_of(whole_, folder_.path() / "whole");
  }
  std::uint64_t taken_from(const Bytes& bytes) const {
    put_file(before(), bytes);
    BakeOptions options = deep_;
    options.previous = before();
    const BakedMap again = bake(scene_, light(1), options);
    EXPECT_TRUE(file_of(again, folder_.path() / "again") == whole_bytes_);
    return again.report.blocks_taken_over;
  }

  BakeOptions deep_ = options();
  Scene scene_;
  BakedMap whole_;
  Bytes good_, whole_bytes_;
};

TEST_F(UntrustedMap, DamageIsNoMoreThanLostWork) {
  const std::uint64_t most = taken_from(good_);
  EXPECT_EQ(most, 15U);
  Random random(93);
  for (int n = 0; n < 60; ++n) {
    SCOPED_TRACE(n);
    Bytes bytes = good_;
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(bytes.size())));
    bytes[at] ^= static_cast<std::byte>(1 << n % 8);
    EXPECT_LE(taken_from(bytes), most);
    // And with checksums that say that all is well.
    pdsm::testing::repair_checksums(bytes);
    EXPECT_LE(taken_from(bytes), most);
  }
  for (const double share : {0.0, 0.001, 0.3, 0.999}) {
    const auto size = static_cast<std::ptrdiff_t>(share * static_cast<double>(good_.size()));
    EXPECT_EQ(taken_from(Bytes(good_.begin(), good_.begin() + size)), 0U);
  }
  std::filesystem::remove(before());
  std::filesystem::create_directory(before());
  BakeOptions options = deep_;
  options.previous = before();
  EXPECT_EQ(bake(scene_, light(1), options).report.blocks_taken_over, 0U);
}

/// Every bit of the chunk of keys, with its checksum made right: of one block at most.
TEST_F(UntrustedMap, KeysThatLieAreFoundOut) {
  const std::size_t chunk = find_chunk(good_, "BKEY");
  const auto at = pdsm::testing::get<std::uint64_t>(good_, pdsm::testing::entry_at(chunk) + 24);
  const std::uint64_t most = taken_from(good_);
  for (std::size_t byte = 0; byte < 2 * 40; ++byte) {
    SCOPED_TRACE(byte);
    Bytes bytes = good_;
    bytes[at + 40 * 3 + byte] ^= static_cast<std::byte>(1 << byte % 8);
    pdsm::testing::repair_checksums(bytes);
    const std::uint64_t taken = taken_from(bytes);
    // What the reader checks, a count and a reserved word, may make the whole chunk unsound.
    EXPECT_TRUE(taken == most - 1 || (byte % 40 >= 32 && taken == 0)) << taken;
  }
}

/// The keys of another map in this one, and of this one in another's: nothing is what its key was made for.
TEST_F(UntrustedMap, KeysOfAnotherMapAreFoundOut) {
  const std::size_t chunk = find_chunk(good_, "BKEY");
  const auto keys_of = [chunk](const Bytes& file) {
    const std::size_t entry = pdsm::testing::entry_at(chunk);
    const auto at = static_cast<std::ptrdiff_t>(pdsm::testing::get<std::uint64_t>(file, entry + 24));
    const auto size = static_cast<std::ptrdiff_t>(pdsm::testing::get<std::uint64_t>(file, entry + 32));
    return Bytes(file.begin() + at, file.begin() + at + size);
  };
  // A plate at another depth changes functions wherever there are any.
  Scene other_scene = scene_of(
      {{plate_mesh({-20, -20, 20, 20, 8}), Roles::both}, {plate_mesh({-3, -3, 3, 3, 4}), Roles::caster}});
  const Bytes other = file_of(bake(other_scene, light(1), deep_), folder_.path() / "other");
  EXPECT_LT(taken_from(pdsm::testing::replace_chunk(other, chunk, keys_of(whole_bytes_))), 16U);
  EXPECT_LT(taken_from(pdsm::testing::replace_chunk(good_, chunk, keys_of(whole_bytes_))), 16U);
  EXPECT_LT(taken_from(pdsm::testing::replace_chunk(good_, chunk, keys_of(other))), 16U);
}

/// A block of a level that is damaged loses the blocks of level 0 that it lies over.
TEST_F(UntrustedMap, DamagedLevelsLoseWhatTheyLieOver) {
  const std::size_t first = find_chunk(good_, "BLCK");
  const auto at = pdsm::testing::get<std::uint64_t>(good_, pdsm::testing::entry_at(first + 16 + 3) + 24);
  Bytes bytes = good_;
  bytes[at] ^= std::byte{1};
  EXPECT_EQ(taken_from(bytes), 11U) << "of 4 x 4, 2 x 2 are lost, and one has changed";
}

TEST_F(UntrustedMap, ShardsMergeToTheSameKeys) {
  std::vector<std::filesystem::path> paths;
  for (std::uint32_t n = 1; n <= 3; ++n) {
    paths.push_back(folder_.path() / std::to_string(n));
    BakeOptions options = deep_;
    // A share takes over what is its own.
    if (n == 2) options.previous = before();
    (void)bake_shard(scene_, light(1), options, {n, 3}, {}, paths.back());
  }
  const BakedMap merged = merge_shards(paths);
  EXPECT_EQ(merged.map.block_keys, whole_.map.block_keys);
  EXPECT_TRUE(file_of(merged, folder_.path() / "merged") == whole_bytes_);
}

TEST_F(UntrustedMap, CheckpointsCarryKeys) {
  const auto file = folder_.path() / "checkpoint";
  BakeOptions without = deep_;
  without.block_keys = false;
  {
    // Blocks without keys are no good to a bake with them.
    Checkpoint checkpoint({file, 0, {}});
    (void)bake(scene_, light(1), without, {}, &checkpoint);
  }
  for (const bool has_keys : {false, true}) {
    Checkpoint checkpoint({file, 0, {}});
    const BakedMap again = bake(scene_, light(1), deep_, {}, &checkpoint);
    EXPECT_EQ(again.report.tiles == 0, has_keys);
    EXPECT_TRUE(file_of(again, folder_.path() / "again") == whole_bytes_);
  }
}

}  // namespace
}  // namespace pdsm::test
