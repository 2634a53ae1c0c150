// SPDX-License-Identifier: Apache-2.0
// Maps of several views: frames, and the same bytes whatever way they are baked.
#include <gtest/gtest.h>

#include <utility>

#include "light/light_faces.h"
#include "pdsm/bake/checkpoint.h"
#include "pdsm/bake/map_key.h"
#include "pdsm/format/error.h"
#include "scratch_folder.h"
#include "support/baked_functions.h"
#include "support/checkpoint_case.h"
#include "support/job_blocks.h"
#include "support/merged_shards.h"
#include "support/random.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

using pdsm::testing::ScratchFolder;

Light bulb() {
  Light light = rect_light(1, 1);
  light.shape = SphereLight{0.2};
  return light;
}

Light half_cube() {
  Light light = rect_light(0.6, 0.4);
  light.faces = 5;
  return light;
}

Light two_sided(std::uint32_t faces) {
  Light light = rect_light(0.6, 0.4);
  light.two_sided = true;
  light.faces = faces;
  return light;
}

/// Things to all sides, some of them across the edges of the cube, in a room.
Scene surrounded() {
  Scene scene;
  add(scene, sphere_mesh({1.5, 0.2, 0.3}, 0.3, 2));
  add(scene, sphere_mesh({-1, -1, 0.2}, 0.25, 2));
  add(scene, sphere_mesh({0.9, 0.2, 1}, 0.25, 2));
  add(scene, box_mesh({-0.3, 1, -1.2}, {0.4, 1.2, -0.8}));
  add(scene, box_mesh({-0.2, -0.4, 1.4}, {0.5, 0.1, 1.6}));
  Mesh room = box_mesh({-3, -2.5, -2}, {2.5, 3, 3.5});
  for (glm::uvec3& t : room.triangles) std::swap(t.y, t.z);
  add(scene, std::move(room));
  return scene;
}

BakeOptions options_of_size(std::uint32_t size) {
  BakeOptions options = small_options(size, size, 12);
  options.mip_levels = 2;
  return options;
}

class SeveralViews : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Light light() const {
    const std::string name = GetParam();
    if (name == "sphere") return bulb();
    return name == "half_cube" ? half_cube() : two_sided(name == "cube" ? 6 : 1);
  }
  [[nodiscard]] BakedMap bake_here(const BakeOptions& options, const BakeCallbacks& callbacks = {},
                                   Checkpoint* checkpoint = nullptr) const {
    return bake(surrounded(), light(), options, callbacks, checkpoint);
  }
};

TEST_P(SeveralViews, FramesAgreeAboutAllPoints) {
  Random random(1);
  const auto first = light_frame(light_face(light(), 0, 64, 64).light);
  for (std::uint32_t view = 0; view < view_count(light()); ++view) {
    const LightFace face = light_face(light(), view, 64, 64);
    for (int n = 0; n < 50; ++n) {
      const glm::dvec3 p(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
      const glm::dvec3 in_first = apply(first, p), here = apply(light_frame(face.light), p);
      const auto turned = face.from_light({in_first.x, in_first.y, in_first.z});
      // A few roundings of coordinates up to 7.
      for (int a = 0; a < 3; ++a) ASSERT_NEAR(turned[static_cast<std::size_t>(a)], here[a], 1e-14) << view;
    }
  }
}

TEST_P(SeveralViews, EachDirectionIsInTheWindowOfAView) {
  // Two views have windows that are fitted.
  const bool is_cube = view_count(light()) > 2;
  EXPECT_EQ(light_face(light(), 1, 32, 48).light.window.has_value(), is_cube);
  Random random(2);
  for (int n = 0; is_cube && n < 500; ++n) {
    const glm::dvec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (light().faces == 5 && p.z <= 0) continue;
    int holding = 0;
    for (std::uint32_t view = 0; view < view_count(light()); ++view) {
      const LightFace face = light_face(light(), view, 32, 48);
      const glm::dvec3 q = apply(light_frame(face.light), p);
      const std::array<double, 4> w = *face.light.window;
      // Between the centres of the outermost texels.
      const double x = 0.5 * (w[2] - w[0]) / face.width, y = 0.5 * (w[3] - w[1]) / face.height;
      holding += q.z > 0 && q.x >= (w[0] + x) * q.z && q.x <= (w[2] - x) * q.z && q.y >= (w[1] + y) * q.z &&
                         q.y <= (w[3] - y) * q.z
                     ? 1
                     : 0;
    }
    EXPECT_GE(holding, 1) << p.x << " " << p.y << " " << p.z;
  }
}

TEST_P(SeveralViews, ThreadsAndTilesChangeNothing) {
  const BakedMap whole = bake_here(options_of_size(150));
  EXPECT_GT(whole.report.events, 1000U);
  ASSERT_EQ(whole.map.views.size(), view_count(light()));
  for (const std::uint32_t threads : {1U, 3U}) {
    BakeOptions options = options_of_size(150);
    options.threads = threads;
    options.tile = 64;
    expect_same_bake(bake_here(options), whole);
  }
}

TEST_P(SeveralViews, RaysThatAreLeftOutHaveNoEvents) {
  BakeOptions options = options_of_size(150);
  options.mip_levels = 0;
  std::uint64_t views = 0;
  for (std::uint32_t view = 0; view < view_count(light()); ++view) {
    const BakeJob job(surrounded(), light(), options, {}, {view, 0});
    if (job.shift_law()) continue;
    ++views;
    EXPECT_EQ(job_blocks(job, true), job_blocks(job, false)) << view;
  }
  EXPECT_GE(views, view_count(light()) > 2 ? 4U : 0U);
}

TEST_P(SeveralViews, CheckpointsGoOn) {
  const ScratchFolder folder;
  const auto file = folder.path() / "a.partial";
  BakeOptions options = options_of_size(150);
  options.tile = 64;
  const BakedMap whole = bake_here(options);
  for (const double share : {0.3, 0.5}) {
    {
      Checkpoint checkpoint({file, 0, {}});
      BakeCallbacks callbacks;
      double done = 0;
      callbacks.progress = [&](const BakeProgress& progress) { done = progress.done; };
      callbacks.cancelled = [&] { return done >= share; };
      EXPECT_THROW((void)bake_here(options, callbacks, &checkpoint), Error);
    }
    Checkpoint checkpoint({file, 0, {}});
    const BakedMap resumed = bake_here(options, {}, &checkpoint);
    expect_same_bake(resumed, whole);
    EXPECT_LT(resumed.report.tiles, whole.report.tiles);
    checkpoint.remove();
  }
}

TEST_P(SeveralViews, ShardsMergeToTheBake) {
  const BakeOptions options = options_of_size(150);
  const BakedMap merged = bake_in_shards(surrounded(), light(), options, 3), whole = bake_here(options);
  expect_same_bake(merged, whole);
  EXPECT_EQ(merged.map.views, whole.map.views);
  EXPECT_EQ(merged.map.samples, whole.map.samples);
}

TEST_P(SeveralViews, KeysTellFacesApart) {
  Light other = light();
  other.faces = 1;
  if (is_sphere(other))
    other.shape = DiskLight{0.2};
  else if (other.faces == light().faces)
    other.two_sided = false;
  const BakeOptions options = options_of_size(64);
  const std::string key = map_key(surrounded(), light(), options).key;
  EXPECT_EQ(key, bake_here(options).report.key);
  EXPECT_NE(key, map_key(surrounded(), other, options).key);
}

INSTANTIATE_TEST_SUITE_P(Lights, SeveralViews, ::testing::Values("sphere", "half_cube", "two_sided", "cube"),
                         [](const auto& of) { return std::string(of.param); });

TEST(LightFaces, RefusesWhatCannotBe) {
  const auto fault = [](Light light, std::uint32_t size) -> std::string {
    try {
      (void)light_face(light, 0, size, size);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  Light light = half_cube();
  EXPECT_EQ(fault(light, 64), "");
  EXPECT_NE(fault(light, 7).find("--resolution: must be at least 8"), std::string::npos);
  light.window = {-1, -1, 1, 1};
  EXPECT_NE(fault(light, 64).find("window: must not be given"), std::string::npos);
  light = half_cube();
  light.faces = 6;
  EXPECT_NE(fault(light, 64).find("faces: must be 1 or 5"), std::string::npos);
}

TEST(SeveralViewsWarning, TellsOfCastersBeforeNear) {
  Scene scene = surrounded();
  EXPECT_TRUE(bake(scene, bulb(), options_of_size(64)).report.warnings.empty());
  add(scene, sphere_mesh({0.3, 0, 0}, 0.05, 1));
  const auto warnings = bake(scene, bulb(), options_of_size(64)).report.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("casters lie before the near"), std::string::npos);
}

}  // namespace
}  // namespace pdsm::test
