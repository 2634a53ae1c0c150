// SPDX-License-Identifier: Apache-2.0
// Maps that are made by projecting triangles, against those that rays trace.
#include "trace/raster_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random.h"
#include "trace/map_rays.h"

namespace pdsm {
namespace {

using test::Random;

constexpr std::int32_t kTexels = 48;
constexpr double kNear = 2, kFar = 6;

MapGrid make_grid() {
  View view;
  view.window = {-0.5, -0.5, 0.5, 0.5};
  view.width = view.height = kTexels;
  view.near_depth = kNear;
  view.far_depth = kFar;
  return make_map_grid(view, kTexels, kTexels);
}

/// A sheet of cells x cells bent quads across far more than all samples' maps. Its seen places are whole
/// multiples of a texel from the centre where `wild` is 0, and edges run through texel centres.
LightSpaceMesh make_sheet(Random& random, int cells, double depth, double wild) {
  LightSpaceMesh mesh;
  const double cell = 160.0 / cells / kTexels;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const double z = depth + wild * random.uniform(-0.3, 0.3);
      const double u = (x - cells / 2 + 0.5 / cell / kTexels + wild * random.uniform(-0.4, 0.4)) * cell;
      const double v = (y - cells / 2 + 0.5 / cell / kTexels + wild * random.uniform(-0.4, 0.4)) * cell;
      mesh.positions.emplace_back(u * z, v * z, z);
    }
  }
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (cells + 1) + x),
                 c = a + static_cast<std::uint32_t>(cells) + 1;
      // Winding must not matter.
      mesh.triangles.emplace_back(a, a + 1, c);
      mesh.triangles.emplace_back(a + 1, random.chance(0.5) ? c : c + 1, c + 1);
      const bool flip = mesh.triangles.back().y == mesh.triangles.back().z;
      mesh.triangles.back() = flip ? glm::uvec3(a + 1, c + 1, c) : glm::uvec3(a + 1, c, c + 1);
    }
  }
  mesh.positions.reserve(mesh.positions.size() + 1);  // Embree reads 16 bytes a vertex
  return mesh;
}

LightSample make_sample(Random& random, bool centre) {
  LightSample sample;
  if (centre) return sample;
  sample.position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0};
  for (float& jitter : sample.jitter) jitter = static_cast<float>(random.uniform(-0.5, 0.4999));
  return sample;
}

/// Depths alone: no bias.
constexpr MapBias kNoBias{0, {0, 0}, std::numeric_limits<double>::infinity()};

struct Maps {
  SampleMap projected, traced;
};

Maps make_maps(const LightSpaceScene& scene, const LightSample& sample,
               std::span<const std::uint32_t> left_out = {}) {
  const MapGrid grid = make_grid();
  const EmbreeScene embree(scene, choose_isa(""), 1);
  const CasterTriangles casters = project_casters(scene, grid, first_caster_depth(grid, sample), 2);
  EXPECT_FALSE(casters.empty());
  Maps maps;
  const TexelRect rect{-4, -8, kTexels + 4, kTexels};
  PacketMask mask;
  DepthImage image;
  SlopeBiasStatistics statistics;
  maps.projected.reset(rect, 1);
  maps.traced.reset(rect, 1);
  mask.reset(maps.projected.rect());
  mask.want(maps.projected.rect());
  const std::uint64_t looked_at = raster_sample_map(embree, casters, grid, sample, kNoBias, left_out, mask,
                                                    image, maps.projected, statistics);
  EXPECT_EQ(looked_at, trace_sample_map(embree, grid, sample, kNoBias, nullptr, maps.traced, statistics));
  return maps;
}

void expect_same_depths(const Maps& maps, double tolerance, int scene) {
  const TexelRect& rect = maps.traced.rect();
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const double a = maps.projected.at(x, y), b = maps.traced.at(x, y);
      ASSERT_TRUE(std::isfinite(a)) << "slipped through at " << x << ", " << y << " of scene " << scene;
      ASSERT_NEAR(a, b, tolerance) << x << ", " << y << " of scene " << scene;
    }
  }
}

TEST(RasterMap, IsWhatRaysMeetOnBentSheets) {
  Random random(81);
  for (int n = 0; n < 60; ++n) {
    LightSpaceScene scene;
    // Triangles far smaller than a texel, and far larger.
    scene.meshes.push_back(make_sheet(random, random.pick({2, 7, 60, 150}), 4, 1));
    expect_same_depths(make_maps(scene, make_sample(random, n % 4 == 0)), 2e-3, n);
  }
}

TEST(RasterMap, LetsNothingSlipThroughEdgesOnTexelCentres) {
  Random random(82);
  for (const int cells : {2, 8, 32, 160}) {
    LightSpaceScene scene;
    scene.meshes.push_back(make_sheet(random, cells, 4, 0));
    expect_same_depths(make_maps(scene, make_sample(random, true)), 1e-5, cells);
  }
}

/// A sheet that goes through the light's plane is cut there, and its other half seen.
TEST(RasterMap, CutsWhatReachesBehindTheLight) {
  LightSpaceScene scene;
  LightSpaceMesh& mesh = scene.meshes.emplace_back();
  mesh.positions.reserve(8);
  mesh.positions = {{-9, -9, 5},      {9, -9, 5},       {-9, 9, 5},     {9, 9, 5},
                    {-0.001F, 0, -1}, {0.02F, 0.3F, 3}, {0.3F, 0.1F, 5}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {4, 5, 6}};
  Random random(83);
  for (int n = 0; n < 20; ++n) {
    const Maps maps = make_maps(scene, make_sample(random, false));
    std::size_t unlike = 0;
    const TexelRect& rect = maps.traced.rect();
    for (std::int32_t y = rect.y0; y < rect.y1; ++y)
      for (std::int32_t x = rect.x0; x < rect.x1; ++x)
        unlike += std::abs(maps.projected.at(x, y) - maps.traced.at(x, y)) > 1e-3F ? 1 : 0;
    EXPECT_LE(unlike, 2u) << n;  // a texel whose centre the border touches
  }
}

TEST(RasterMap, PassesOverWhatIsLeftOut) {
  Random random(84);
  LightSpaceScene far_alone, both;
  far_alone.meshes.push_back(make_sheet(random, 20, 5, 1));
  both.meshes = {make_sheet(random, 3, 3, 1), far_alone.meshes[0]};
  const CasterTriangles casters = project_casters(both, make_grid(), kEmitterShare * kNear, 1);
  std::vector<std::uint32_t> near;
  for (std::uint32_t slot = 0; slot < casters.surfaces.size(); ++slot)
    if (casters.surfaces[casters.ids[slot]].mesh == 0) near.push_back(slot);
  for (int n = 0; n < 10; ++n) {
    const LightSample sample = make_sample(random, false);
    const Maps one = make_maps(far_alone, sample), two = make_maps(both, sample, near);
    const TexelRect& rect = one.projected.rect();
    for (std::int32_t y = rect.y0; y < rect.y1; ++y)
      for (std::int32_t x = rect.x0; x < rect.x1; ++x)
        ASSERT_EQ(one.projected.at(x, y), two.projected.at(x, y)) << x << ", " << y;
  }
}

}  // namespace
}  // namespace pdsm
