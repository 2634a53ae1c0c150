// SPDX-License-Identifier: Apache-2.0
// Lossless bakes of scenes that are mirrored, scaled, moved, turned or added to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>

#include "support/baked_functions.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

constexpr double kNear = 2, kFar = 8;

std::vector<Plate> random_plates(std::uint64_t seed) {
  Random random(seed);
  std::vector<Plate> plates;
  for (int n = 0; n < 4; ++n) {
    const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    plates.push_back({x, y, x + random.uniform(0.2, 2), y + random.uniform(0.2, 2), random.uniform(2.5, 7)});
  }
  plates.push_back({-20, -20, 20, 20, 7.9});
  return plates;
}

Scene scene_of(const std::vector<Plate>& plates) {
  Scene scene;
  for (const Plate& plate : plates) add(scene, plate);
  return scene;
}

Light key_light() {
  Light light = rect_light(1.4, 0.9);
  set_view(light, 0.5, 0.4, kNear, kFar);
  return light;
}

BakeOptions lossless(std::uint32_t width, std::uint32_t height) {
  BakeOptions options = small_options(width, height, 50);
  options.epsilon = 0;
  return options;
}

/// Functions of texel pairs agree wherever no event is near.
template <typename Partner>
void expect_same_functions(const BakedFunctions& a, const BakedFunctions& b, double width, Partner partner) {
  std::size_t compared = 0;
  for (std::uint32_t j = 0; j < a.view().height; ++j) {
    for (std::uint32_t i = 0; i < a.view().width; ++i) {
      const auto [bi, bj] = partner(i, j);
      for (const double z :
           depths_between(a.view(), a.map().coding, a.function(i, j), b.function(bi, bj), width)) {
        ASSERT_EQ(a.value(i, j, z), b.value(bi, bj, z)) << "texel " << i << ", " << j << ", z " << z;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, std::size_t{2} * a.view().width * a.view().height);
}

class Symmetry : public testing::TestWithParam<Walk> {};

/// Texel centres are at (i + 1/2) / R, so a mirrored scene with mirrored samples and jitter is the mirror
/// image, also on grids of odd size and for maps of another pitch.
TEST_P(Symmetry, MirroredSceneGivesMirroredFunctions) {
  for (const std::uint32_t map_width : {33u, 99u, 11u}) {
    for (const bool along_x : {true, false}) {
      const std::vector<Plate> plates = random_plates(61);
      std::vector<Plate> mirrored = plates;
      for (Plate& p : mirrored) {
        if (along_x)
          std::tie(p.x0, p.x1) = std::pair(-p.x1, -p.x0);
        else
          std::tie(p.y0, p.y1) = std::pair(-p.y1, -p.y0);
      }
      BakeOptions options = lossless(33, 21);
      options.map_width = map_width;
      options.walk = GetParam();
      Random random(62);
      options.light_samples = make_light_samples(key_light(), 50, PointSet::jittered, 5);
      BakeOptions other = options;
      for (LightSample& sample : other.light_samples) {
        const std::size_t axis = along_x ? 0 : 1;
        sample.position[axis] *= -1;
        sample.jitter[axis] *= -1;
      }
      const BakedFunctions a(scene_of(plates), key_light(), options),
          b(scene_of(mirrored), key_light(), other);
      expect_same_functions(a, b, event_width(a, b), [&](std::uint32_t i, std::uint32_t j) {
        return along_x ? std::pair(32 - i, j) : std::pair(i, 20 - j);
      });
    }
  }
}

/// Powers of two scale every float exactly.
TEST_P(Symmetry, ScaledSceneGivesTheSameBytes) {
  BakeOptions options = lossless(40, 30);
  options.walk = GetParam();
  for (const double epsilon : {0.0, 0.02}) {
    options.epsilon = epsilon;
    const BakedFunctions first(scene_of(random_plates(63)), key_light(), options);
    for (const double scale : {0x1.0p20, 0x1.0p-20}) {
      std::vector<Plate> plates = random_plates(63);
      for (Plate& p : plates) p = {p.x0 * scale, p.y0 * scale, p.x1 * scale, p.y1 * scale, p.z * scale};
      Light light = rect_light(1.4 * scale, 0.9 * scale);
      set_view(light, 0.5, 0.4, kNear * scale, kFar * scale);
      expect_same_bytes(first, {scene_of(plates), light, options});
    }
  }
}

/// Moved by 1e6 and turned, light and all: the same functions in light space but for one depth quantum. World
/// positions keep 2^-33 metres in double; an edge moves by a float's last bit at most.
TEST_P(Symmetry, MovedAndTurnedSceneGivesTheSameFunctions) {
  BakeOptions options = lossless(40, 30);
  options.walk = GetParam();
  const Scene scene = scene_of(random_plates(64));
  const BakedFunctions first(scene, key_light(), options);
  for (const bool turned : {false, true}) {
    glm::dmat4 motion = glm::translate(glm::dmat4(1), glm::dvec3(1e6, -1e6, 1e6));
    if (turned) motion = glm::rotate(motion, 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    Scene moved = scene;
    for (Geometry& geometry : moved.geometry) geometry.local_to_world = motion;
    Light light = key_light();
    light.position = glm::dvec3(motion[3]);
    light.direction = glm::dvec3(motion[2]);
    light.up = glm::dvec3(motion[1]);
    const BakedFunctions baked(moved, light, options);
    expect_same_functions(first, baked,
                          event_width(first, baked) + depth_step(first.view(), first.map().coding),
                          [](std::uint32_t i, std::uint32_t j) { return std::pair(i, j); });
  }
}

/// Another opaque triangle in the light's plane of view never lightens anything.
TEST_P(Symmetry, AnAddedTriangleNeverLowersAttenuation) {
  Random random(65);
  BakeOptions options = lossless(32, 24);
  options.walk = GetParam();
  bool darker = false;
  for (int n = 0; n < 10; ++n) {
    const std::vector<Plate> plates = random_plates(66 + static_cast<std::uint64_t>(n));
    Scene more = scene_of(plates);
    const double z = random.uniform(2.2, 7);
    Mesh triangle;
    for (int corner = 0; corner < 3; ++corner) {
      triangle.positions.emplace_back(glm::dvec3(random.uniform(-3, 3), random.uniform(-3, 3), z));
    }
    triangle.triangles = {{0, 1, 2}};
    add(more, triangle, Roles::caster);
    const BakedFunctions before(scene_of(plates), key_light(), options), after(more, key_light(), options);
    for (std::uint32_t j = 0; j < 24; ++j) {
      for (std::uint32_t i = 0; i < 32; ++i) {
        for (const double at : depths_between(before.view(), before.map().coding, before.function(i, j),
                                              after.function(i, j), event_width(before, after))) {
          ASSERT_GE(after.value(i, j, at), before.value(i, j, at))
              << "case " << n << ", texel " << i << ", " << j << ", z " << at;
          darker = darker || after.value(i, j, at) > before.value(i, j, at);
        }
      }
    }
  }
  EXPECT_TRUE(darker);
}

/// `volume` is `all` up to each ray's end, then holds what it had there.
TEST_P(Symmetry, VolumeHoldsTheValueAtTheDomainsEnd) {
  BakeOptions options = lossless(40, 30);
  options.walk = GetParam();
  const Scene scene = scene_of(random_plates(67));
  const BakedFunctions volume(scene, key_light(), options);
  options.receivers = Receivers::all;
  const BakedFunctions all(scene, key_light(), options);
  const double width = event_width(volume, all) + depth_step(all.view(), all.map().coding);
  std::size_t held = 0;
  for (std::uint32_t j = 0; j < 30; ++j) {
    for (std::uint32_t i = 0; i < 40; ++i) {
      const double end = volume.domain_end(i, j);
      const auto function = all.function(i, j);
      ASSERT_EQ(all.domain_end(i, j), kFar);
      // The floor ends every ray; its code is rounded up (2^-20: 7.9 as a float).
      ASSERT_GE(end, 7.9 - 0x1.0p-20);
      ASSERT_LE(end, 7.9 + 0x1.0p-20 + depth_step(volume.view(), volume.map().coding));
      bool event_at_end = false;
      for (const FunctionVertex& v : function) {
        event_at_end =
            event_at_end || std::abs(decode_depth(all.view(), all.map().coding, v.depth) - end) < width;
      }
      for (const double z :
           depths_between(all.view(), all.map().coding, function, volume.function(i, j), width)) {
        if (z >= end - width) break;
        ASSERT_EQ(volume.value(i, j, z), all.value(i, j, z)) << "texel " << i << ", " << j;
      }
      if (event_at_end) continue;
      const double last = all.value(i, j, end);
      for (const double z : {end + width, kFar, 10 * kFar})
        ASSERT_EQ(volume.value(i, j, z), last) << "texel " << i << ", " << j;
      ++held;
    }
  }
  EXPECT_GT(held, 600u);
}

/// `surfaces` is `volume` at the depths of the scene's own surfaces and within the bias of them, for fewer
/// pieces.
TEST_P(Symmetry, SurfacesKeepTheValuesOnSurfaces) {
  BakeOptions options = lossless(40, 30);
  options.walk = GetParam();
  const std::vector<Plate> plates = random_plates(68);
  const BakedFunctions volume(scene_of(plates), key_light(), options);
  options.receivers = Receivers::surfaces;
  const BakedFunctions surfaces(scene_of(plates), key_light(), options);
  EXPECT_LT(surfaces.vertex_count(), volume.vertex_count());
  const double width = event_width(volume, surfaces) + depth_step(volume.view(), volume.map().coding);
  std::size_t compared = 0;
  for (std::uint32_t j = 0; j < 30; ++j) {
    for (std::uint32_t i = 0; i < 40; ++i) {
      for (const Plate& plate : plates) {
        const double x = plate.z * volume.slope_x(i), y = plate.z * volume.slope_y(j);
        if (x < plate.x0 || x > plate.x1 || y < plate.y0 || y > plate.y1) continue;
        const auto function = volume.function(i, j);
        for (const double offset : {-0.4, 0.0, 0.4}) {
          const double z = plate.z + offset * volume.report().bias;
          const bool near_event = std::any_of(function.begin(), function.end(), [&](const FunctionVertex& v) {
            return std::abs(decode_depth(volume.view(), volume.map().coding, v.depth) - z) < width;
          });
          if (near_event) continue;
          ASSERT_EQ(surfaces.value(i, j, z), volume.value(i, j, z))
              << "texel " << i << ", " << j << ", z " << z;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 1000u);
}

INSTANTIATE_TEST_SUITE_P(BothWalks, Symmetry, testing::Values(Walk::midpoint, Walk::exact),
                         [](const auto& walk) { return walk.param == Walk::exact ? "Exact" : "Midpoint"; });

}  // namespace
}  // namespace pdsm::test
