// SPDX-License-Identifier: Apache-2.0
// Casters in the order of their places, with hidden ones passed over, against all of them in the scene's
// order.
#include "trace/caster_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/projection_grid.h"
#include "support/random.h"
#include "trace/hidden_chunks.h"
#include "trace/raster_map.h"

namespace pdsm {
namespace {

using test::kFar;
using test::kLight;
using test::kNear;
using test::make_grid;
using test::Random;

constexpr std::int32_t kTexels = 96;

CasterTriangles project(const LightSpaceScene& scene, std::uint32_t threads) {
  return project_casters(scene, make_grid(kTexels), kLight, kEmitterShare * kNear, threads);
}

/// Triangles of any winding, `size` of the window wide.
LightSpaceMesh make_soup(Random& random, int count, double size, double least_depth) {
  LightSpaceMesh mesh;
  for (int n = 0; n < count; ++n) {
    const double u = random.uniform(-0.7, 0.7), v = random.uniform(-0.7, 0.7);
    for (int corner = 0; corner < 3; ++corner) {
      const double z = random.uniform(least_depth, kFar);
      mesh.positions.emplace_back((u + random.uniform(-size, size)) * z,
                                  (v + random.uniform(-size, size)) * z, z);
    }
    const auto first = static_cast<std::uint32_t>(3 * n);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

/// A sheet that faces the light, a share of it holes; flat, or bent by `bend` metres.
LightSpaceMesh make_sheet(Random& random, double bend, double holes) {
  constexpr std::uint32_t kCells = 70;
  LightSpaceMesh mesh;
  for (std::uint32_t y = 0; y <= kCells; ++y) {
    for (std::uint32_t x = 0; x <= kCells; ++x) {
      const double z = 3.2 + bend * random.uniform(-1, 1);
      mesh.positions.emplace_back((1.6 * x / kCells - 0.8) * z, (1.6 * y / kCells - 0.8) * z, z);
    }
  }
  for (std::uint32_t y = 0; y < kCells; ++y) {
    for (std::uint32_t x = 0; x < kCells; ++x) {
      if (random.chance(holes)) continue;
      const std::uint32_t a = y * (kCells + 1) + x, c = a + kCells + 1;
      mesh.triangles.emplace_back(a, c, a + 1);
      mesh.triangles.emplace_back(a + 1, c, c + 1);
    }
  }
  return mesh;
}

LightSpaceMesh turned(LightSpaceMesh mesh) {
  for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
  return mesh;
}

/// Small triangles behind a sheet, and large ones among all. The sheet is there twice, first turned away, so
/// that what is entered last has to win among equal depths.
LightSpaceScene make_scene(Random& random, double bend) {
  LightSpaceScene scene;
  const LightSpaceMesh sheet = make_sheet(random, bend, 0.02);
  scene.meshes = {make_soup(random, 30000, 0.01, 3.5), turned(sheet), make_soup(random, 4, 0.9, 2.5), sheet,
                  make_soup(random, 500, 0.03, 2.5)};
  return scene;
}

SampleShift make_shift(Random& random) {
  SampleShift shift;
  for (std::size_t a = 0; a < 2; ++a) {
    shift.scale[a] = static_cast<float>(random.uniform(-0.5, 0.5) * kTexels);
    shift.shift[a] = static_cast<float>(random.uniform(0, 1));
  }
  return shift;
}

PacketMask make_mask(Random& random, const TexelRect& rect) {
  PacketMask mask;
  mask.reset(rect);
  for (int n = 0; n < 25; ++n) {
    const auto x = static_cast<std::int32_t>(random.uniform(rect.x0, rect.x1 - 20)),
               y = static_cast<std::int32_t>(random.uniform(rect.y0, rect.y1 - 20));
    mask.want({x, y, x + 20, y + 20});
  }
  return mask;
}

/// The same triangles, each in the slot that its id says.
CasterTriangles in_scene_order(const CasterTriangles& casters) {
  CasterTriangles result = casters;
  for (std::size_t slot = 0; slot < casters.surfaces.size(); ++slot) {
    const std::uint32_t id = casters.ids[slot];
    result.ids[id] = id;
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t a = 0; a < 2; ++a) result.g[a][n][id] = casters.g[a][n][slot];
      result.k[n][id] = casters.k[n][slot];
    }
  }
  return result;
}

TEST(CasterOrder, AndPassingOverHiddenOnesChangesNothing) {
  Random random(91);
  const TexelRect rect{-8, -4, kTexels + 4, kTexels};
  DepthImage image, plain;
  for (int n = 0; n < 20; ++n) {
    const CasterTriangles casters = project(make_scene(random, n % 2 == 0 ? 0 : 0.05), 2),
                          ordered = in_scene_order(casters);
    const SampleShift shift = make_shift(random);
    const PacketMask mask = make_mask(random, rect);
    image.reset(rect);
    plain.reset(rect);
    enter_casters(casters, shift, {}, mask, image);
    for (std::uint32_t chunk = 0; chunk < casters.bounds.size(); ++chunk)
      enter_chunk(ordered, chunk, shift, {}, plain);
    for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
      for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
        if (!mask.is_wanted(x, y)) continue;
        ASSERT_EQ(image.key(x, y), plain.key(x, y)) << x << ", " << y << " of scene " << n;
      }
    }
  }
}

TEST(CasterOrder, LetsMostHiddenTrianglesBePassedOver) {
  Random random(92);
  LightSpaceScene scene;
  scene.meshes = {make_soup(random, 4000, 0.01, 3.5), make_sheet(random, 0.05, 0)};
  const CasterTriangles casters = project(scene, 2);
  DepthImage image;
  image.reset({0, 0, kTexels, kTexels});
  PacketMask mask;
  mask.reset(image.rect);
  mask.want(image.rect);
  const SampleShift centre{{0, 0}, {0.5F, 0.5F}};
  for (std::uint32_t chunk = 0; chunk < casters.front_chunks; ++chunk)
    enter_chunk(casters, chunk, centre, {}, image);
  HiddenChunks hidden;
  hidden.reset(image, mask);
  std::size_t seen = 0;
  for (std::size_t chunk = casters.front_chunks; chunk < casters.bounds.size(); ++chunk)
    seen += hidden.may_be_seen(casters.bounds[chunk], centre) ? 1 : 0;
  EXPECT_LT(seen, (casters.bounds.size() - casters.front_chunks) / 3);
}

TEST(CasterOrder, IsTheSameForAnyNumberOfThreads) {
  Random random(93);
  const LightSpaceScene scene = make_scene(random, 0.05);
  const CasterTriangles one = project(scene, 1);
  std::vector<std::uint32_t> ids(one.ids.begin(), one.ids.begin() + std::ssize(one.surfaces));
  std::ranges::sort(ids);
  std::vector<std::uint32_t> all(one.surfaces.size());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(ids, all);
  for (const std::uint32_t threads : {2u, 3u, 7u}) {
    const CasterTriangles many = project(scene, threads);
    EXPECT_EQ(many.ids, one.ids) << threads;
    EXPECT_EQ(many.g, one.g) << threads;
    EXPECT_EQ(many.front_chunks, one.front_chunks) << threads;
    EXPECT_TRUE(std::ranges::equal(many.surfaces, one.surfaces, {}, &CasterTriangles::Surface::normal,
                                   &CasterTriangles::Surface::normal))
        << threads;
  }
}

}  // namespace
}  // namespace pdsm
