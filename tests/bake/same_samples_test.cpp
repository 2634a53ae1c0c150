// SPDX-License-Identifier: Apache-2.0
// Lossless bakes against the same-samples oracle: the count of blocked samples at any depth differs from the
// exact one by no more than the samples whose map texel holds an edge (support/same_samples.h).
#include <gtest/gtest.h>

#include "support/baked_functions.h"
#include "support/random.h"
#include "support/same_samples.h"

namespace pdsm::test {
namespace {

constexpr double kNear = 1.5, kFar = 8;

std::vector<Plate> random_plates(Random& random) {
  std::vector<Plate> plates;
  const std::int64_t count = random.integer(1, 4);
  for (std::int64_t n = 0; n < count; ++n) {
    const double z = random.uniform(2, 7), x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    // Plates as thin as 0.1: wires, too. In float already, as the mesh will have them.
    const auto rounded = [](double v) { return static_cast<double>(static_cast<float>(v)); };
    plates.push_back({rounded(x), rounded(y), rounded(x + random.uniform(0.1, 2)),
                      rounded(y + random.uniform(0.1, 2)), rounded(z)});
  }
  return plates;
}

Scene scene_of(const std::vector<Plate>& plates) {
  Scene scene;
  for (const Plate& plate : plates) add(scene, plate, Roles::caster);
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar}, Roles::receiver);
  return scene;
}

MapModel model_of(const BakedFunctions& baked, Walk walk) {
  const View& view = baked.view();
  return {2 / (1 / view.near_depth + 1 / view.far_depth),
          baked.map_pitch_x(),
          baked.map_pitch_y(),
          texel_reach(walk),
          baked.report().bias,
          baked.report().depth_tolerance};
}

/// Compares every texel at many depths; returns the mean width of the bounds.
double expect_oracle(const BakedFunctions& baked, const std::vector<Plate>& plates, Walk walk) {
  const MapModel model = model_of(baked, walk);
  const auto& samples = baked.map().samples;
  const auto total = static_cast<double>(samples.size());
  double width = 0, compared = 0;
  const double near = baked.view().near_depth;
  for (std::uint32_t j = 0; j < baked.view().height; ++j) {
    for (std::uint32_t i = 0; i < baked.view().width; ++i) {
      for (int n = 0; n < 40; ++n) {
        const double z = near + (kFar - near) * (n + 0.37) / 40;
        const BlockedCount blocked =
            count_blocked(samples, plates, model, {z * baked.slope_x(i), z * baked.slope_y(j), z});
        const double count = baked.value(i, j, z) * total;
        EXPECT_GE(count, blocked.certain - 1e-6) << "texel " << i << ", " << j << ", z " << z;
        EXPECT_LE(count, blocked.possible + 1e-6) << "texel " << i << ", " << j << ", z " << z;
        if (testing::Test::HasFailure()) return 1;
        width += (blocked.possible - blocked.certain) / total;
        ++compared;
      }
    }
  }
  return width / compared;
}

struct GridChoice {
  std::uint32_t width, height, map_width, map_height;
};
/// Maps as fine as the PDSM, finer, coarser; different along both axes.
constexpr GridChoice kGrids[] = {{40, 30, 40, 30}, {13, 11, 52, 33}, {48, 40, 24, 10}, {16, 30, 48, 15}};

class SameSamples : public testing::TestWithParam<Walk> {
 protected:
  [[nodiscard]] static BakeOptions lossless(const GridChoice& grid, std::uint32_t samples) {
    BakeOptions options = small_options(grid.width, grid.height, samples);
    options.map_width = grid.map_width;
    options.map_height = grid.map_height;
    options.walk = GetParam();
    options.epsilon = 0;
    options.bias = 1e-4;
    options.receivers = Receivers::all;
    return options;
  }
};

TEST_P(SameSamples, RectangleLight) {
  Random random(31);
  double width = 0;
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(n);
    Light light = rect_light(random.uniform(0, 2), random.uniform(0, 2));
    set_view(light, 0.5, 0.4, kNear, kFar);
    const std::vector<Plate> plates = random_plates(random);
    BakeOptions options = lossless(kGrids[n % 4], random.count(1, 120));
    options.points = n % 2 == 0 ? PointSet::lattice : PointSet::jittered;
    options.seed = static_cast<std::uint64_t>(n);
    width += expect_oracle({scene_of(plates), light, options}, plates, GetParam());
    if (HasFailure()) return;
  }
  // The comparison says something: on average, an eighth of the samples at most is in doubt.
  EXPECT_LT(width / 12, 0.125);
}

TEST_P(SameSamples, DiskLight) {
  Random random(32);
  for (int n = 0; n < 4; ++n) {
    SCOPED_TRACE(n);
    Light light = disk_light(0.8);
    set_view(light, 0.5, 0.4, kNear, kFar);
    const std::vector<Plate> plates = random_plates(random);
    expect_oracle({scene_of(plates), light, lossless(kGrids[n], 64)}, plates, GetParam());
  }
}

/// Samples anywhere before near take the general path.
TEST_P(SameSamples, TiltedSamples) {
  Random random(33);
  for (int n = 0; n < 8; ++n) {
    SCOPED_TRACE(n);
    Light light = rect_light(1, 1);
    set_view(light, 0.5, 0.4, kNear, kFar);
    const std::vector<Plate> plates = random_plates(random);
    BakeOptions options = lossless(kGrids[n % 4], 1);
    for (int k = 0; k < 40; ++k) {
      LightSample sample;
      sample.position = {random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-1, 1)};
      sample.jitter = {static_cast<float>(random.uniform(-0.5, 0.499)),
                       static_cast<float>(random.uniform(-0.5, 0.499))};
      options.light_samples.push_back(sample);
    }
    expect_oracle({scene_of(plates), light, options}, plates, GetParam());
  }
}

/// Samples in the light's plane, but beside the light: what hides them may lie before a near that was fitted
/// to the light's own hull, and counts all the same, from near on.
TEST_P(SameSamples, SamplesBesideTheLight) {
  for (const double lift : {0.0, 1e-9}) {
    SCOPED_TRACE(lift);
    Light light = rect_light(0.1, 0.1);
    light.window = {-0.2, -0.2, 0.2, 0.2};
    light.far_depth = kFar;
    const std::vector<Plate> plates{{1, -1, 1.5, 1, 1}, {-0.25, -0.25, 0.25, 0.25, 4}};
    BakeOptions options = lossless({32, 32, 32, 32}, 1);
    for (const double x : {1.25, 1.5, 1.75}) options.light_samples.push_back({{x, 0.125, lift}, {0, 0}, 1});
    const BakedFunctions baked(scene_of(plates), light, options);
    ASSERT_GT(baked.view().near_depth, 3.9);
    expect_oracle(baked, plates, GetParam());
  }
}

/// Samples lifted out of the plane by next to nothing take the general path, those in it the shift law: both
/// must be within the same bounds, and where no sample is in doubt agree to the count.
TEST_P(SameSamples, LiftedSamplesAgreeWithPlanarOnes) {
  Random random(34);
  for (int n = 0; n < 4; ++n) {
    SCOPED_TRACE(n);
    Light light = rect_light(1.2, 0.8);
    set_view(light, 0.5, 0.4, kNear, kFar);
    const std::vector<Plate> plates = random_plates(random);
    const BakeOptions planar = lossless(kGrids[n], 64);
    BakeOptions lifted = planar;
    lifted.light_samples = make_light_samples(light, 64, PointSet::lattice, 0);
    for (LightSample& sample : lifted.light_samples) sample.position[2] = 1e-9;
    const BakedFunctions a(scene_of(plates), light, planar), b(scene_of(plates), light, lifted);
    const MapModel model = model_of(a, GetParam());
    for (std::uint32_t j = 0; j < a.view().height; ++j) {
      for (std::uint32_t i = 0; i < a.view().width; ++i) {
        for (int step = 0; step < 20; ++step) {
          const double z = kNear + (kFar - kNear) * (step + 0.37) / 20;
          const BlockedCount blocked =
              count_blocked(a.map().samples, plates, model, {z * a.slope_x(i), z * a.slope_y(j), z});
          const double difference = 64 * std::abs(a.value(i, j, z) - b.value(i, j, z));
          ASSERT_LE(difference, blocked.possible - blocked.certain + 1e-6)
              << "texel " << i << ", " << j << ", z " << z;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothWalks, SameSamples, testing::Values(Walk::midpoint, Walk::exact),
                         [](const auto& walk) { return walk.param == Walk::exact ? "Exact" : "Midpoint"; });

}  // namespace
}  // namespace pdsm::test
