// SPDX-License-Identifier: Apache-2.0
// Slopes are kept before the next receiver from where on more than one ray in a thousand would leak.
#include "tile/slope_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trace/light_space.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kTexels = 192;  // the grid of 48 x 48 packets asks every texel once
constexpr double kFar = 8, kConstant = 1e-3;
/// Of what a slope adds, a hundredth of a metre and more: depths of up to 8 m are traced to 2^-18 of
/// themselves.
constexpr double kRounding = 8 * 0x1p-18 / 0.01;

MapGrid make_grid() {
  View view;
  view.width = view.height = kTexels;
  view.window = {-0.5, -0.5, 0.5, 0.5};
  view.near_depth = 1;
  view.far_depth = kFar;
  return make_map_grid(view, kTexels, kTexels);
}

struct Texels {
  double x0 = 0, y0 = 0, x1 = kTexels, y1 = kTexels;
};

/// What the light's centre sees at `texels` of the plane z = depth + rise x.
LightSpaceMesh sheet(const Texels& texels, double rise, double depth) {
  LightSpaceMesh mesh;
  for (const double x : {texels.x0, texels.x1}) {
    for (const double y : {texels.y0, texels.y1}) {
      const double u = x / kTexels - 0.5, v = y / kTexels - 0.5, z = depth / (1 - rise * u);
      mesh.positions.emplace_back(u * z, v * z, z);
    }
  }
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  mesh.positions.reserve(5);  // Embree reads 16 bytes a vertex
  return mesh;
}

/// What the slope of the plane z = 4 + rise x adds over a reach of one texel p = 1 / 192 (docs/maths.md,
/// "Bias"): n = (rise, 0, -1), so that |n . d| = 1 - rise u.
double added(double rise, double column) {
  const double facing = 1 - rise * (column / kTexels - 0.5), shrink = rise / kTexels;
  return 4 / facing * shrink / (facing - shrink);
}

double limit_of(std::vector<LightSpaceMesh> meshes, std::uint32_t threads = 2) {
  LightSpaceScene scene;
  scene.meshes = std::move(meshes);
  const EmbreeScene embree(scene, choose_isa(""), threads);
  return find_slope_limit(embree, make_grid(), Walk::exact, kConstant, threads).from;
}

/// A slope with a receiver 1 cm behind: nearer than what a slope of 1/4 or more adds.
void add_blocked(std::vector<LightSpaceMesh>& meshes, const Texels& texels, double rise) {
  meshes.push_back(sheet(texels, rise, 4));
  meshes.push_back(sheet(texels, rise, 4.01));
}

constexpr Texels kLeft{0, 0, 96, kTexels}, kRight{96, 0, kTexels, kTexels};

TEST(SlopeLimit, IsNoneWhereNoReceiverIsInTheWay) {
  EXPECT_TRUE(std::isinf(limit_of({sheet({}, 0.5, 4)})));
  // 2.5 m behind at least, where the slope adds less than 0.1 m.
  EXPECT_TRUE(std::isinf(limit_of({sheet({}, 0.5, 4), sheet({}, 0, 7.9)})));
}

TEST(SlopeLimit, SlopesThatAddLessThanTheConstantGoFree) {
  // It adds 0.2 mm. A receiver is in the way 0.3 mm behind, where it is not taken for the same surface.
  EXPECT_TRUE(std::isinf(limit_of({sheet({}, 0.01, 4), sheet({}, 0.01, 4.0003)})));
}

TEST(SlopeLimit, LiesBetweenSlopesThatAreFreeAndThoseInTheWay) {
  std::vector<LightSpaceMesh> meshes{sheet(kLeft, 1, 4)};
  add_blocked(meshes, kRight, 1.5);
  const double limit = limit_of(meshes);
  EXPECT_GT(limit, added(1, 96));
  // The slope in the way that adds least is that of the column nearest to the axis; one ray in a thousand is
  // less than a column.
  EXPECT_LT(limit, added(1.5, 97.5));
  EXPECT_GT(limit, added(1.5, 96.5) * (1 - kRounding));
}

TEST(SlopeLimit, OneRayInAThousandMayLeak) {
  // All of 192 x 192 rays meet something: 36 of them may leak.
  const auto limit_with = [](double columns, double rows) {
    std::vector<LightSpaceMesh> meshes{sheet({}, 0, 7.9)};
    add_blocked(meshes, {96, 96, 96 + columns, 96 + rows}, 1);
    return limit_of(meshes);
  };
  EXPECT_TRUE(std::isinf(limit_with(6, 6)));
  // The last of 37 columns adds most: just that one is kept.
  EXPECT_LT(limit_with(37, 1), added(1, 96 + 36.5) * (1 + kRounding));
  EXPECT_GT(limit_with(37, 1), added(1, 96 + 36.5) * (1 - kRounding));
}

TEST(SlopeLimit, IsTheSameForAnyNumberOfThreads) {
  std::vector<LightSpaceMesh> meshes;
  add_blocked(meshes, kLeft, 1);
  add_blocked(meshes, kRight, 0.5);
  const double one = limit_of(meshes, 1);
  EXPECT_TRUE(std::isfinite(one));
  for (const std::uint32_t threads : {2U, 3U, 8U}) EXPECT_EQ(limit_of(meshes, threads), one);
}

}  // namespace
}  // namespace pdsm
