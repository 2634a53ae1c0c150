// SPDX-License-Identifier: Apache-2.0
// Maps that are made by projecting triangles, against those that rays trace.
#include "trace/raster_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "support/projection_grid.h"
#include "support/random.h"
#include "trace/caster_volume.h"
#include "trace/map_rays.h"

namespace pdsm {
namespace {

using test::kFar;
using test::kLight;
using test::kNear;
using test::make_grid;
using test::Random;

constexpr std::int32_t kTexels = 48;

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
  const MapGrid grid = make_grid(kTexels);
  const EmbreeScene embree(scene, choose_isa(""), 1);
  const CasterTriangles casters = project_casters(scene, grid, kLight, first_caster_depth(grid, sample), 2);
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

/// A sheet with holes is traced either way: among all that there is, or after what is whole was projected.
TEST(RasterMap, SeesThroughHolesAsRaysDo) {
  Random random(90);
  CutoutMask mask{2, 2, {255, 0, 0, 255}, {}, 0.5F};
  for (int n = 0; n < 20; ++n) {
    LightSpaceScene scene;
    LightSpaceMesh& holed = scene.meshes.emplace_back(make_sheet(random, random.pick({2, 7, 60}), 3, 1));
    holed.mask = std::make_shared<const CutoutMask>(mask);
    // From far more than a texel of a map to far less.
    const float scale = random.pick({1.0F, 30.0F, 1000.0F});
    for (const glm::vec3& p : holed.positions) holed.mask_places.push_back(scale * glm::vec2(p));
    scene.meshes.push_back(make_sheet(random, 7, 4, 1));
    const Maps maps = make_maps(scene, make_sample(random, n % 4 == 0));
    expect_same_depths(maps, 2e-3, n);
    std::size_t through = 0, all = 0;
    const TexelRect& rect = maps.traced.rect();
    for (std::int32_t y = rect.y0; y < rect.y1; ++y, all += static_cast<std::size_t>(rect.x1 - rect.x0))
      for (std::int32_t x = rect.x0; x < rect.x1; ++x) through += maps.traced.at(x, y) > 3.5F ? 1 : 0;
    EXPECT_GT(through, all / 4) << n;
    EXPECT_LT(through, 3 * all / 4) << n;
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

/// A fan of triangles around a point in the map on the plane 0.2 x + z = 5, whose rim is farther than floats
/// hold: cut off, with no gap between neighbours.
LightSpaceMesh make_wide_fan(Random& random, int count) {
  LightSpaceMesh mesh;
  const auto put = [&](double x, double y) { mesh.positions.emplace_back(x, y, 5 - 0.2 * x); };
  mesh.positions.reserve(static_cast<std::size_t>(count) + 2);
  put(random.uniform(-1, 1), random.uniform(-1, 1));
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * std::numbers::pi * (n + random.uniform(0, 0.4)) / count,
                 radius = std::exp(random.uniform(std::log(1e2), std::log(1e6)));
    put(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (int n = 0; n < count; ++n)
    mesh.triangles.emplace_back(0u, static_cast<std::uint32_t>(1 + n),
                                static_cast<std::uint32_t>(1 + (n + 1) % count));
  return mesh;
}

TEST(RasterMap, CutsWhatReachesFarBeside) {
  Random random(85);
  const MapGrid grid = make_grid(kTexels);
  for (int n = 0; n < 60; ++n) {
    LightSpaceScene scene;
    scene.meshes.push_back(make_wide_fan(random, random.pick({3, 5, 24, 400})));
    const LightSample sample = make_sample(random, n % 4 == 0);
    const Maps maps = make_maps(scene, sample);
    const TexelRect& rect = maps.projected.rect();
    for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
      for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
        const double u = grid.origin[0] + (x + 0.5 + sample.jitter[0]) * grid.pitch[0];
        // The plane along s_x + (u F - s_x) z / F.
        const double s = sample.position[0], rate = u - s / grid.focus_depth;
        const double depth = (5 - 0.2 * s) / (1 + 0.2 * rate);
        ASSERT_NEAR(maps.projected.at(x, y), depth, 1e-3) << x << ", " << y << " of scene " << n;
      }
    }
  }
}

/// Neighbours see an edge from its two ends, and have to cut it at one point.
TEST(RasterMap, CutsAnEdgeTheSameFromBothEnds) {
  Random random(88);
  const CasterVolume volume(make_grid(kTexels), kLight, kEmitterShare * kNear);
  const auto corners_of = [&](const std::array<glm::dvec3, 3>& triangle) {
    const CasterPolygon polygon = volume.clip(triangle);
    std::set<std::array<double, 3>> corners;
    for (int n = 0; n < polygon.count; ++n) {
      const glm::dvec3& p = polygon.corners[static_cast<std::size_t>(n)];
      corners.insert({p.x, p.y, p.z});
    }
    return corners;
  };
  std::size_t most = 0;
  for (int n = 0; n < 2000; ++n) {
    std::array<glm::dvec3, 3> p;
    for (glm::dvec3& corner : p) {
      const double far = std::exp(random.uniform(0, 12));
      corner = {far * random.uniform(-1, 1), far * random.uniform(-1, 1), random.uniform(-2, 6)};
    }
    const auto corners = corners_of({p[0], p[1], p[2]});
    EXPECT_EQ(corners, corners_of({p[1], p[0], p[2]}));
    most = std::max(most, corners.size());
  }
  EXPECT_GT(most, 5u);
}

/// What a caster beside all maps, or behind the light, leaves of the others is all of them.
TEST(RasterMap, KeepsOnlyWhatSomeMapHolds) {
  Random random(86);
  LightSpaceScene alone;
  alone.meshes.push_back(make_sheet(random, 30, 4, 1));
  LightSpaceScene both = alone;
  LightSpaceMesh& beside = both.meshes.emplace_back();
  beside.positions.reserve(16);
  beside.positions = {{9, -9, 4},   {1e6F, -9, 4},   {9, 9, 4},       // far beside
                      {3, -9, -3},  {3, 9, -3},      {9, 0, 5},       // a wall through the light's plane
                      {-1, -1, -1}, {1, -1, -1e-3F}, {0, 1, -0.5F}};  // behind the light
  beside.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const auto project = [](const LightSpaceScene& scene) {
    return project_casters(scene, make_grid(kTexels), kLight, kEmitterShare * kNear, 2);
  };
  const CasterTriangles one = project(alone), two = project(both);
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one.g, two.g);
  EXPECT_EQ(one.k, two.k);
  EXPECT_EQ(one.ids, two.ids);
}

/// Triangles that only some samples see, at the borders of their maps, are kept.
TEST(RasterMap, KeepsWhatAnySampleSees) {
  Random random(87);
  const MapGrid grid = make_grid(kTexels);
  for (int n = 0; n < 400; ++n) {
    const double z = random.pick({1e-2, 0.3, 1.5, 2.0, 3.0, 5.9, 50.0});
    LightSample sample = make_sample(random, false);
    for (std::size_t a = 0; a < 2; ++a) sample.position[a] = random.pick({-0.5, 0.5});
    // A point on the border of what the sample's rays reach between near and far.
    const double reach = 0.5 * (1 / kNear - 1 / kFar) / 2, u = random.pick({-1, 1}) * (0.5 + reach),
                 v = random.uniform(-0.5, 0.5), way = z / grid.focus_depth;
    const double x = sample.position[0] * (1 - way) + u * z, y = sample.position[1] * (1 - way) + v * z;
    const double size = 0.01 * z / grid.focus_depth;
    LightSpaceScene scene;
    scene.meshes.emplace_back().positions = {
        {x - size, y - size, z}, {x + size, y - size, z}, {x, y + size, z}};
    scene.meshes[0].triangles = {{0, 1, 2}};
    const CasterTriangles casters = project_casters(scene, grid, kLight, kEmitterShare * kNear, 1);
    EXPECT_EQ(casters.surfaces.size(), 1u) << "at depth " << z;
  }
}

TEST(RasterMap, PassesOverWhatIsLeftOut) {
  Random random(84);
  LightSpaceScene far_alone, both;
  far_alone.meshes.push_back(make_sheet(random, 20, 5, 1));
  both.meshes = {make_sheet(random, 3, 3, 1), far_alone.meshes[0]};
  const CasterTriangles casters = project_casters(both, make_grid(kTexels), kLight, kEmitterShare * kNear, 1);
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
