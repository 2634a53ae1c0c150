// SPDX-License-Identifier: Apache-2.0
// What bake() and predict_bake() refuse, and how: one line "--option: reason" and the kind of failure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInfinity = std::numeric_limits<double>::infinity();

Scene plate_over_floor() {
  Scene scene;
  add(scene, Plate{-1, -1, 1, 1, 4});
  add(scene, Plate{-9, -9, 9, 9, 8});
  return scene;
}

void expect_failure(Failure failure, const std::string& begin, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "nothing thrown, expected " << begin;
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.failure(), failure) << what;
    EXPECT_EQ(what.substr(0, begin.size()), begin) << what;
    EXPECT_GT(what.size(), begin.size()) << "a reason";
    EXPECT_EQ(what.find('\n'), std::string::npos) << "one line";
  }
}

struct BadOption {
  const char* option;
  std::function<void(BakeOptions&)> set;
};

TEST(BakeFaults, OptionsOutOfRangeAreUsageErrorsThatNameTheOption) {
  const BadOption bad[] = {
      {"--samples: ", [](BakeOptions& o) { o.samples = 0; }},
      {"--samples: ", [](BakeOptions& o) { o.samples = 65537; }},
      {"--samples: ", [](BakeOptions& o) { o.samples = 0xFFFFFFFF; }},
      {"--samples: ", [](BakeOptions& o) { o.light_samples.resize(65537); }},
      {"--resolution: ", [](BakeOptions& o) { o.width = 0; }},
      {"--resolution: ", [](BakeOptions& o) { o.height = 0; }},
      {"--resolution: ", [](BakeOptions& o) { o.width = 16385; }},
      {"--resolution: ", [](BakeOptions& o) { o.height = 0x80000000; }},
      {"--map-resolution: ", [](BakeOptions& o) { o.map_width = 16385; }},
      {"--map-resolution: ", [](BakeOptions& o) { o.map_height = 0xFFFFFFFF; }},
      {"--epsilon: ", [](BakeOptions& o) { o.epsilon = 1; }},
      {"--epsilon: ", [](BakeOptions& o) { o.epsilon = -1e-9; }},
      {"--epsilon: ", [](BakeOptions& o) { o.epsilon = kNan; }},
      {"--epsilon: ", [](BakeOptions& o) { o.epsilon = kInfinity; }},
      {"--depth-tolerance: ", [](BakeOptions& o) { o.depth_tolerance = -1; }},
      {"--depth-tolerance: ", [](BakeOptions& o) { o.depth_tolerance = kNan; }},
      {"--depth-tolerance: ", [](BakeOptions& o) { o.depth_tolerance = kInfinity; }},
      {"--bias: ", [](BakeOptions& o) { o.bias = -1e-6; }},
      {"--bias: ", [](BakeOptions& o) { o.bias = kNan; }},
      {"--bias: ", [](BakeOptions& o) { o.bias = kInfinity; }},
      {"--tile: ", [](BakeOptions& o) { o.tile = 63; }},
      {"--tile: ", [](BakeOptions& o) { o.tile = 100; }},
      {"--threads: ", [](BakeOptions& o) { o.threads = 1025; }},
      {"--mip-levels: ", [](BakeOptions& o) { o.mip_levels = 7; }},
      {"--mip-levels: ", [](BakeOptions& o) { o.mip_levels = 0xFFFFFFFF; }},
      {"--isa: ", [](BakeOptions& o) { o.isa = "mmx"; }},
      {"--isa: ", [](BakeOptions& o) { o.isa = "AVX2"; }},
      {"--isa: ", [](BakeOptions& o) { o.isa = "sse2,threads=99"; }},
  };
  for (const BadOption& fault : bad) {
    BakeOptions options = small_options(8, 8, 4);
    fault.set(options);
    expect_failure(Failure::usage, fault.option,
                   [&] { (void)bake(plate_over_floor(), rect_light(1, 1), options); });
    expect_failure(Failure::usage, fault.option,
                   [&] { (void)predict_bake(plate_over_floor(), rect_light(1, 1), options); });
  }
}

TEST(BakeFaults, LightSamplesMustBeFiniteAndBeforeNear) {
  for (const std::array<double, 3>& position :
       {std::array<double, 3>{kNan, 0, 0}, {0, kInfinity, 0}, {0, 0, 4}, {0, 0, 100}}) {
    BakeOptions options = small_options(8, 8, 4);
    options.light_samples = {{position, {0, 0}, 1}};
    expect_failure(Failure::usage,
                   "light samples: ", [&] { (void)bake(plate_over_floor(), rect_light(1, 1), options); });
  }
}

TEST(BakeFaults, ValuesAtTheEndsOfTheirRangesAreTaken) {
  for (const std::function<void(BakeOptions&)>& set : std::vector<std::function<void(BakeOptions&)>>{
           [](BakeOptions& o) { o.samples = 1; }, [](BakeOptions& o) { o.epsilon = 0; },
           [](BakeOptions& o) { o.epsilon = std::nextafter(1.0, 0.0); },
           [](BakeOptions& o) { o.depth_tolerance = 0; }, [](BakeOptions& o) { o.bias = 0; },
           [](BakeOptions& o) { o.tile = 64; }, [](BakeOptions& o) { o.tile = 6400; },
           [](BakeOptions& o) { o.mip_levels = 6; }, [](BakeOptions& o) { o.threads = 0; },
           [](BakeOptions& o) { o.isa = "sse2"; }, [](BakeOptions& o) { o.bias = 1e6; },
           [](BakeOptions& o) { o.depth_tolerance = 1e6; }, [](BakeOptions& o) { o.map_width = 1; }}) {
    BakeOptions options = small_options(8, 8, 4);
    set(options);
    EXPECT_NO_THROW((void)bake(plate_over_floor(), rect_light(1, 1), options));
  }
}

TEST(BakeFaults, TooLittleMemoryIsAResourceError) {
  for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{1} << 20}) {
    for (const std::uint32_t tile : {0u, 64u}) {
      BakeOptions options = small_options(100, 100, 16);
      options.memory = memory;
      options.tile = tile;
      expect_failure(Failure::resource,
                     "--memory: ", [&] { (void)bake(plate_over_floor(), rect_light(1, 1), options); });
    }
  }
}

TEST(BakeFaults, CancellingEndsTheBakeAtOnceOrLater) {
  for (const int polls : {0, 1, 5}) {
    for (const std::uint32_t threads : {1u, 3u}) {
      BakeOptions options = small_options(200, 200, 64);
      options.threads = threads;
      options.tile = 64;
      int polled = 0;
      BakeCallbacks callbacks;
      callbacks.cancelled = [&] { return polled++ >= polls; };
      expect_failure(Failure::interrupted,
                     "bake: ", [&] { (void)bake(plate_over_floor(), rect_light(1, 1), options, callbacks); });
      EXPECT_EQ(polled, polls + 1) << "nothing is asked again once it has said yes";
    }
  }
}

TEST(BakeFaults, ProgressGrowsFromNothingToAll) {
  std::vector<double> done;
  BakeCallbacks callbacks;
  callbacks.progress = [&](const BakeProgress& progress) {
    EXPECT_FALSE(progress.step.empty());
    done.push_back(progress.done);
  };
  (void)bake(plate_over_floor(), rect_light(1, 1), small_options(100, 100, 64), callbacks);
  ASSERT_FALSE(done.empty());
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_GE(done.front(), 0);
  EXPECT_LE(done.back(), 1 + 1e-12);
}

TEST(BakeFaults, NearBehindFarIsAnInputError) {
  Light light = rect_light(1, 1);
  light.name = "key";
  light.near_depth = 9;
  expect_failure(Failure::input,
                 "key.near: ", [&] { (void)bake(plate_over_floor(), light, small_options(8, 8, 4)); });
}

TEST(BakePrediction, IsOfTheRightOrder) {
  const BakeOptions options = small_options(128, 128, 64);
  const BakePrediction prediction = predict_bake(plate_over_floor(), rect_light(1, 1), options);
  const BakeReport report = bake(plate_over_floor(), rect_light(1, 1), options).report;
  // The trial's four of 64 samples see what the others do, but for where the penumbra and the margins lie.
  EXPECT_GT(prediction.rays, report.rays / 2);
  EXPECT_LT(prediction.rays, report.rays * 2);
  EXPECT_GT(prediction.events, report.events / 2);
  EXPECT_LT(prediction.events, report.events * 2);
  EXPECT_EQ(prediction.tile, report.tile);
  EXPECT_EQ(prediction.tiles, report.tiles);
  EXPECT_GT(prediction.memory_bytes, 0u);
}

}  // namespace
}  // namespace pdsm::test
