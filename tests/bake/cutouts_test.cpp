// SPDX-License-Identifier: Apache-2.0
// Casters with holes: crisp where the mask's texels are large, their mean where they are small.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/cutouts.h"
#include "support/random.h"
#include "support/same_samples.h"

namespace pdsm::test {
namespace {

constexpr double kPlateDepth = 4;

/// Exact counts at every depth.
BakeOptions exact_options(std::uint32_t edge, std::uint32_t samples) {
  BakeOptions options = small_options(edge, edge, samples);
  options.epsilon = 0;
  options.depth_tolerance = 1e-4;
  options.bias = 0.01;
  options.receivers = Receivers::all;
  return options;
}

Light square_light() {
  Light light = rect_light(1, 1);
  set_view(light, 0.5, 0.5, 2, 8);
  return light;
}

/// A plate of 32 x 32 m with a mask of 16 x 16 texels of 2 m, or of 1/8 of that size, with one hole.
struct HoledPlate {
  double size = 32;
  std::uint32_t low = 5, high = 9;  ///< texels of the hole, half-open, along both axes

  [[nodiscard]] double texel() const { return size / 16; }
  [[nodiscard]] Scene scene() const {
    const CutoutMask mask = make_mask(16, 16, 0.5F, [&](std::uint32_t i, std::uint32_t j) {
      return !(i >= low && i < high && j >= low && j < high);
    });
    Scene scene;
    CutoutMask whole_beyond = mask;
    whole_beyond.wrap = {MaskWrap::clamp, MaskWrap::clamp};
    // The plate reaches far beyond its mask, whose borders are solid.
    constexpr double kBeyond = 3;
    const double x = size * (kBeyond + 0.5);
    add(scene,
        cut_plate({-x, -x, x, x, kPlateDepth}, whole_beyond, {-kBeyond, -kBeyond, 1 + kBeyond, 1 + kBeyond}),
        Roles::caster);
    return scene;
  }
  /// The hole's borders lie midway between texel centres, so on borders of texels.
  [[nodiscard]] double edge(std::uint32_t texel_border) const { return texel_border * texel() - size / 2; }
};

/// How many samples must be, and may be, blocked: as count_blocked() has it, with the plate everywhere but in
/// the hole. Up to half a texel from its corners the hole is round.
BlockedCount count_beside_hole(std::span<const LightSample> samples, const HoledPlate& plate,
                               const MapModel& model, const std::array<double, 3>& point) {
  const double low = plate.edge(plate.low), high = plate.edge(plate.high), round = plate.texel() / 2;
  BlockedCount count;
  for (const LightSample& sample : samples) {
    const double share = kPlateDepth / point[2], focus = model.focus_depth;
    const double reach = model.reach * kPlateDepth * focus / focus;
    bool touches = true, within = true;
    std::array<bool, 2> near_end{};
    for (std::size_t a = 0; a < 2; ++a) {
      const double at = sample.position[a] + (point[a] - sample.position[a]) * share;
      const double moved =
          (model.delta + 0x1.0p-23 * point[2]) * share / point[2] * std::abs(point[a] - sample.position[a]);
      const double r = reach * (a == 0 ? model.pitch_x : model.pitch_y) + moved + 1e-5;
      const Cover c = cover(at, r, low, high);
      touches = touches && c.touches;
      within = within && c.wholly;
      near_end[a] = at - r < low + round || at + r > high - round;
    }
    if (!touches) ++count.certain;
    if (!within || (near_end[0] && near_end[1])) ++count.possible;
  }
  return count;
}

class OneHole : public testing::TestWithParam<double> {};

/// Mask texels of two sizes, each larger than a map texel: the hole's edge is the maps' own.
TEST_P(OneHole, IsWhereTheMaskHasIt) {
  const HoledPlate plate{GetParam()};
  const BakedFunctions baked(plate.scene(), square_light(), exact_options(64, 64));
  const double focus = 2 / (1 / 2.0 + 1 / 8.0);
  const MapModel model{focus, baked.map_pitch_x(), baked.map_pitch_y(), texel_reach(Walk::exact), 0.01, 1e-4};
  std::uint64_t certain = 0, possible = 0;
  for (std::uint32_t j = 0; j < 64; j += 3) {
    for (std::uint32_t i = 0; i < 64; i += 3) {
      for (const double z : {4.5, 6.0, 7.9}) {
        const std::array<double, 3> point{baked.slope_x(i) * z, baked.slope_y(j) * z, z};
        const BlockedCount count = count_beside_hole(baked.map().samples, plate, model, point);
        const double blocked = baked.value(i, j, z) * 64;
        ASSERT_GE(blocked, count.certain - 1e-6) << i << " " << j << " " << z;
        ASSERT_LE(blocked, count.possible + 1e-6) << i << " " << j << " " << z;
        certain += count.certain;
        possible += count.possible;
      }
    }
  }
  // The oracle knows nearly all.
  EXPECT_LT(possible - certain, 0.15 * (22 * 22 * 3 * 64));
  EXPECT_LT(possible, 22U * 22 * 3 * 64);
}

INSTANTIATE_TEST_SUITE_P(OfTwoSizes, OneHole, testing::Values(32.0, 8.0), [](const auto& size) {
  return "Plate" + std::to_string(static_cast<int>(size.param));
});

/// The hole of 2 x 2 m is seen from (x, y, 8) as one of 4 x 4 m in the light's plane, moved by -(x, y): of a
/// light of 3 x 3 m the share beside it is blocked. n x n strata: numerics section 3, K = 4 n - 4 for a
/// convex outline.
TEST(Cutouts, ARectLightThroughAHole) {
  const HoledPlate plate{8};
  Light light = rect_light(3, 3);
  set_view(light, 0.5, 0.5, 2, 8);
  BakeOptions options = exact_options(64, 1024);
  options.points = PointSet::jittered;
  const BakedFunctions baked(plate.scene(), light, options);
  const MapModel model{3.2, baked.map_pitch_x(), baked.map_pitch_y(), texel_reach(Walk::exact), 0.01, 1e-4};
  const double strata = 4 * 32 - 4, tolerance = std::sqrt(strata * std::log(2 / 1e-9) / 2) / 1024;
  for (const std::uint32_t i : {20U, 24U, 28U, 32U, 36U}) {
    for (const std::uint32_t j : {22U, 31U, 40U}) {
      const std::array<double, 3> point{baked.slope_x(i) * 7.99, baked.slope_y(j) * 7.99, 7.99};
      double open = 1;
      for (std::size_t a = 0; a < 2; ++a) {
        // A point s of the light sees through x if s + (p - s) h / z = x.
        const double share = kPlateDepth / point[2];
        const double low = (plate.edge(plate.low) - point[a] * share) / (1 - share),
                     high = (plate.edge(plate.high) - point[a] * share) / (1 - share);
        open *= std::max(0.0, std::min(high, 1.5) - std::max(low, -1.5)) / 3;
      }
      const BlockedCount count = count_beside_hole(baked.map().samples, plate, model, point);
      EXPECT_NEAR(baked.value(i, j, point[2]), 1 - open,
                  tolerance + (count.possible - count.certain) / 1024.0)
          << i << " " << j;
    }
  }
}

/// Stripes of three solid texels in four. Linear alpha is at least a quarter over 3.5 of them: 7/8, where the
/// mean alpha and the share of solid texels are 3/4.
constexpr double kStripes = 0.875;
Scene striped_scene(double texels_a_metre) {
  const double x = 3, periods = 2 * x * texels_a_metre / 4;
  Scene scene;
  add(scene,
      cut_plate({-x, -x, x, x, kPlateDepth},
                make_mask(4, 1, 0.25F, [](std::uint32_t i, std::uint32_t) { return i != 2; }),
                {0, 0, periods, 1}),
      Roles::caster);
  return scene;
}

struct Minified {
  std::uint32_t edge, samples;
};
class SmallMaskTexels : public testing::TestWithParam<Minified> {};

/// Each texel of each sample's map takes one point of the mask, at random. Over n points the mean is off by
/// sqrt(ln(2 / p) / (2 n)) at the most, but for a chance of p (Hoeffding).
TEST_P(SmallMaskTexels, GiveTheShareThatIsThere) {
  const auto [edge, samples] = GetParam();
  const double metres_a_texel = kPlateDepth / edge;
  const BakedFunctions baked(striped_scene(1000 / metres_a_texel), square_light(),
                             exact_options(edge, samples));
  const auto tolerance = [](double points, double p) { return std::sqrt(std::log(2 / p) / (2 * points)); };
  const double texels = edge * edge;
  double sum = 0;
  for (std::uint32_t j = 0; j < edge; ++j) {
    for (std::uint32_t i = 0; i < edge; ++i) {
      const double value = baked.value(i, j, 6);
      EXPECT_NEAR(value, kStripes, tolerance(samples, 1e-9 / texels));
      sum += value;
    }
  }
  EXPECT_NEAR(sum / texels, kStripes, tolerance(texels * samples, 1e-9));
}

INSTANTIATE_TEST_SUITE_P(AtTwoResolutions, SmallMaskTexels,
                         testing::Values(Minified{16, 1024}, Minified{64, 64}),
                         [](const auto& c) { return "Edge" + std::to_string(c.param.edge); });

/// Stripes of which a period is a map texel: each texel sees half of it solid, at a point of its own. Over n
/// texels the variance of what N samples give, each blocked with chance 1/2, is 1/(4 N), but for its own
/// standard deviation of sqrt(2 / n) of that. Were whole texels decided by what lies at their centres, all
/// would be alike.
TEST(Cutouts, TexelsThatSeeTheSameChooseForThemselves) {
  constexpr std::uint32_t kEdge = 64, kSamples = 64;
  const double x = 3, periods = 2 * x * kEdge / kPlateDepth;
  Scene scene;
  add(scene,
      cut_plate({-x, -x, x, x, kPlateDepth},
                make_mask(64, 64, 0.5F, [](std::uint32_t i, std::uint32_t) { return i < 32; }),
                {0, 0, periods, periods}),
      Roles::caster);
  const BakedFunctions baked(scene, square_light(), exact_options(kEdge, kSamples));
  double squares = 0;
  for (std::uint32_t j = 0; j < kEdge; ++j)
    for (std::uint32_t i = 0; i < kEdge; ++i) squares += std::pow(baked.value(i, j, 6) - 0.5, 2);
  constexpr double kTexels = kEdge * kEdge;
  EXPECT_NEAR(squares / kTexels * 4 * kSamples, 1, 6 * std::sqrt(2 / kTexels));
}

/// Both sides of a leaf, each a surface of its own, have their holes at the same places: two with holes of
/// their own would block 1 - 1/8^2. Hits are floats: weights are off by 2^-23, places by so much of 4,800
/// texels, in either bake. Of four texels two borders are as near as both together to one point in 876.
TEST(Cutouts, ACopyChangesNothing) {
  const Scene once = striped_scene(800);
  Scene twice = once;
  Mesh other = *once.geometry[0].mesh;
  for (glm::uvec3& t : other.triangles) t = {t.z, t.y, t.x};
  add(twice, std::move(other), Roles::caster);
  const BakeOptions options = exact_options(32, 32);
  const BakedFunctions a(once, square_light(), options), b(twice, square_light(), options);
  double unlike = 0;
  for (std::uint32_t j = 0; j < 32; ++j)
    for (std::uint32_t i = 0; i < 32; ++i) unlike += std::abs(a.value(i, j, 6) - b.value(i, j, 6));
  EXPECT_LT(unlike / (32 * 32), 1.0 / 876);
}

TEST(Cutouts, AMaskWithoutHolesIsAPlate) {
  // Within a quantum of depth: one is traced, the other projected.
  Scene whole, masked;
  const Plate plate{-1.1, -0.9, 1.2, 1.3, kPlateDepth};
  add(whole, plate, Roles::caster);
  add(masked, cut_plate(plate, make_mask(3, 3, 1, [](std::uint32_t, std::uint32_t) { return true; })),
      Roles::caster);
  const BakeOptions options = exact_options(48, 32);
  const BakedFunctions a(whole, square_light(), options), b(masked, square_light(), options);
  for (std::uint32_t j = 0; j < 48; ++j) {
    for (std::uint32_t i = 0; i < 48; ++i) {
      for (const double z : {3.9, 5.0, 7.9}) ASSERT_EQ(a.value(i, j, z), b.value(i, j, z)) << i << " " << j;
    }
  }
}

/// A leaf that is the last receiver ends the functions, in its holes too.
TEST(Cutouts, EndTheDomainAsIfWhole) {
  Scene scene;
  add(scene, Plate{-0.4, -0.4, 0.4, 0.4, 3}, Roles::caster);
  add(scene, cut_plate({-9, -9, 9, 9, 6}, leaf_mask(), {0, 0, 40, 40}));
  BakeOptions options = exact_options(32, 16);
  options.receivers = Receivers::volume;
  const BakedFunctions baked(scene, square_light(), options);
  for (std::uint32_t j = 0; j < 32; ++j)
    for (std::uint32_t i = 0; i < 32; ++i) ASSERT_NEAR(baked.domain_end(i, j), 6, 1e-3) << i << " " << j;
}

Light foliage_light() {
  Light light = rect_light(1, 0.8);
  light.window = {-0.5, -0.4, 0.5, 0.4};
  return light;
}

BakeOptions foliage_options() {
  BakeOptions options = small_options(150, 130, 24);
  options.threads = 2;
  return options;
}

const ModelledFeature* find_feature(const BakedFunctions& baked, const std::string& name) {
  const auto& list = baked.report().modelled;
  const auto found = std::ranges::find(list, name, &ModelledFeature::feature);
  return found == list.end() ? nullptr : &*found;
}

TEST(Cutouts, AreNamedWhereThereAreAny) {
  const BakedFunctions foliage(foliage_scene(), foliage_light(), foliage_options());
  ASSERT_NE(find_feature(foliage, "cutouts"), nullptr);
  EXPECT_TRUE(find_feature(foliage, "cutouts")->modelled);
  EXPECT_EQ(find_feature(foliage, "cutouts")->reason,
            "casters have holes: they are traced, and all others projected");
  Scene plain;
  add(plain, Plate{-0.5, -0.3, 0.2, 0.4, 3.5});
  add(plain, Plate{-9, -9, 9, 9, 8});
  // Out of sight: dropped before anything is built.
  add(plain, cut_plate({100, 100, 101, 101, 5}, leaf_mask()));
  const BakedFunctions without(plain, foliage_light(), foliage_options());
  EXPECT_EQ(find_feature(without, "cutouts"), nullptr);
}

TEST(CutoutsRepeat, ForAnyThreadsTileAndOrder) {
  const BakedFunctions first(foliage_scene(), foliage_light(), foliage_options());
  EXPECT_GT(first.vertex_count(), 1000U);
  for (const std::uint32_t threads : {1U, 4U}) {
    for (const std::uint32_t tile : {64U, 128U}) {
      SCOPED_TRACE(std::to_string(threads) + " threads, tiles of " + std::to_string(tile));
      BakeOptions options = foliage_options();
      options.threads = threads;
      options.tile = tile;
      expect_same_bytes(first, {foliage_scene(), foliage_light(), options});
    }
  }
  Scene shuffled = foliage_scene();
  Random random(62);
  random.shuffle(shuffled.geometry);
  BakeOptions options = foliage_options();
  options.light_samples = make_light_samples(foliage_light(), options.samples, PointSet::lattice, 0);
  const BakedFunctions given(foliage_scene(), foliage_light(), options);
  random.shuffle(options.light_samples);
  expect_same_bytes(given, {shuffled, foliage_light(), options});
}

TEST(Cutouts, MasksThatMakeNoSenseAreRefused) {
  const auto fault = [](const std::function<void(Mesh&, CutoutMask&)>& spoil) {
    CutoutMask mask = leaf_mask();
    Mesh mesh = cut_plate({-1, -1, 1, 1, 4}, mask);
    spoil(mesh, mask);
    if (mesh.mask) mesh.mask = std::make_shared<const CutoutMask>(mask);
    Scene scene;
    add(scene, std::move(mesh));
    try {
      static_cast<void>(bake(scene, foliage_light(), small_options(8, 8, 4)));
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault([](Mesh&, CutoutMask&) {}), "");
  EXPECT_EQ(fault([](Mesh&, CutoutMask& m) { m.alpha.pop_back(); }),
            "geometry 0:mask: 1023 bytes of alpha for 32 x 32 texels");
  EXPECT_EQ(fault([](Mesh&, CutoutMask& m) { m.width = 0; }),
            "geometry 0:mask: 0 x 32 texels: must be 1 to 16384 along each axis");
  EXPECT_EQ(fault([](Mesh&, CutoutMask& m) { m.cutoff = -1; }),
            "geometry 0:mask: the cutoff must be 0 or more");
  EXPECT_EQ(fault([](Mesh&, CutoutMask& m) { m.cutoff = NAN; }),
            "geometry 0:mask: the cutoff must be 0 or more");
  EXPECT_EQ(fault([](Mesh&, CutoutMask& m) { m.wrap[1] = static_cast<MaskWrap>(7); }),
            "geometry 0:mask: the wrap mode is unknown");
  EXPECT_EQ(fault([](Mesh& m, CutoutMask&) { m.mask_places.pop_back(); }),
            "geometry 0:mask: 3 places for 4 positions");
  EXPECT_EQ(fault([](Mesh& m, CutoutMask&) { m.mask = nullptr; }),
            "geometry 0:mask: places in a mask that is not there");
  EXPECT_EQ(fault([](Mesh& m, CutoutMask&) { m.closed = true; }),
            "geometry 0:mask: a mesh with a mask can't be closed");
}

TEST(Cutouts, PlacesThatAreNotFiniteAreLeftOut) {
  Scene scene;
  Mesh mesh = cut_plate({-1, -1, 1, 1, 4}, leaf_mask());
  mesh.mask_places[1].x = NAN;
  add(scene, std::move(mesh));
  const BakedFunctions baked(scene, square_light(), small_options(8, 8, 4));
  EXPECT_EQ(baked.report().warnings.size(), 1U);
}

}  // namespace
}  // namespace pdsm::test
