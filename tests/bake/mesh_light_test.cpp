// SPDX-License-Identifier: Apache-2.0
// Lights that are meshes: where their samples lie, and maps of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "light/mesh_samples.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/look_up.h"
#include "support/baked_functions.h"
#include "support/exact_truth.h"
#include "support/scenes.h"

namespace pdsm::test {
namespace {

using Samples = std::vector<std::array<double, 3>>;

Light mesh_light(Mesh mesh) {
  Light light = rect_light(1, 1);
  light.shape = MeshLight{std::make_shared<const Mesh>(std::move(mesh))};
  return light;
}

Mesh closed_mesh(Mesh mesh) {
  mesh.closed = is_closed(mesh);
  return mesh;
}

/// A closed prism along x, half length 1, inscribed into a cylinder.
Mesh tube(double radius, std::uint32_t sides = 64) {
  Mesh mesh;
  const auto at = [&](std::uint32_t n, float x) {
    const double angle = 2 * std::numbers::pi * (n % sides) / sides;
    return glm::vec3(x, radius * std::cos(angle), radius * std::sin(angle));
  };
  for (std::uint32_t n = 0; n < sides; ++n) {
    const std::uint32_t k = 6 * n;
    for (const glm::vec3& p :
         {at(n, -1), at(n + 1, -1), at(n, 1), at(n + 1, 1), glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0)})
      mesh.positions.push_back(p);
    for (const glm::uvec3& t : {glm::uvec3(0, 1, 2), {1, 3, 2}, {1, 0, 4}, {2, 3, 5}})
      mesh.triangles.push_back(t + k);
  }
  return closed_mesh(std::move(mesh));
}

/// Share of samples beyond an offset along a direction.
double share_beyond(const Samples& samples, const glm::dvec3& direction, double offset) {
  const auto is_beyond = [&](const auto& p) {
    return glm::dot(glm::dvec3(p[0], p[1], p[2]), direction) > offset;
  };
  return static_cast<double>(std::ranges::count_if(samples, is_beyond)) / static_cast<double>(samples.size());
}

/// All strata are crossed, as if the samples were drawn apart.
double apart(double samples) {
  return sampling_tolerance(samples, samples);
}

constexpr PointSet kSets[] = {PointSet::lattice, PointSet::jittered};

TEST(MeshSamples, OfASheetAreUniformOnIt) {
  const Mesh sheet = plate_mesh(Plate{-1, -0.5, 1, 0.5, 0.25});
  constexpr std::uint32_t kCount = 1024;
  // With n strata a square, the curve goes through squares of an area from 1/n to 4/n one after the other. A
  // line meets sqrt(n) of them, and each has points of 6 strata at most; the sheet is half of a square.
  const double slack = sampling_tolerance(6 * std::sqrt(2.0 * kCount), kCount);
  for (const PointSet points : kSets) {
    const Samples samples = mesh_samples(sheet, {kCount, points, 5});
    ASSERT_EQ(samples.size(), kCount);
    for (const auto& p : samples) {
      ASSERT_EQ(p[2], 0.25);
      ASSERT_LE(std::abs(p[0]), 1);
      ASSERT_LE(std::abs(p[1]), 0.5);
    }
    for (const double share : {0.1, 0.35, 0.5, 0.8}) {
      EXPECT_NEAR(share_beyond(samples, {1, 0, 0}, 1 - 2 * share), share, slack);
      EXPECT_NEAR(share_beyond(samples, {0, 1, 0}, 0.5 - share), share, slack);
    }
  }
}

TEST(MeshSamples, OfASphereLookLikeADiskFromAllSides) {
  const Mesh sphere = closed_mesh(sphere_mesh({0, 0, 0}, 1, 5));
  ASSERT_TRUE(sphere.closed);
  constexpr std::uint32_t kCount = 8192;
  for (const PointSet points : kSets) {
    const Samples samples = mesh_samples(sphere, {kCount, points, 0});
    double within = 0;
    for (const auto& p : samples) {
      ASSERT_LE(std::hypot(p[0], p[1], p[2]), 1 + 1e-6);
      within += std::hypot(p[0], p[1], p[2]) < 0.5 ? 1 : 0;
    }
    for (const glm::dvec3& direction :
         {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {0.6, 0, 0.8}, {0.48, -0.6, 0.64}})
      for (const double offset : {-0.8, -0.4, 0.0, 0.3, 0.6, 0.9})
        EXPECT_NEAR(share_beyond(samples, direction, offset), disk_half_plane(1, offset), apart(kCount))
            << offset;
    // Of density 1 / sqrt(1 - r^2): from 0 to pi/6, of sin^2 of the angle whose sine is r, of that to pi/2.
    EXPECT_NEAR(within / kCount, (std::numbers::pi / 6 - std::sqrt(3) / 4) / (std::numbers::pi / 2),
                apart(kCount));
  }
}

TEST(MeshSamples, OfATubeAreUniformAlongAndAcross) {
  constexpr std::uint32_t kCount = 8192;
  constexpr double kRadius = 0.02;
  for (const bool is_inside_out : {false, true}) {
    Mesh mesh = tube(kRadius);
    ASSERT_TRUE(mesh.closed);
    if (is_inside_out)
      for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    const Samples samples = mesh_samples(mesh, {kCount, PointSet::lattice, 0});
    for (const double share : {0.1, 0.35, 0.5, 0.8}) {
      EXPECT_NEAR(share_beyond(samples, {1, 0, 0}, 1 - 2 * share), share, apart(kCount));
      // What the caps add, of a share of r in all that is emitted.
      for (const glm::dvec3& across : {glm::dvec3(0, 1, 0), {0, 0.6, -0.8}})
        EXPECT_NEAR(share_beyond(samples, across, kRadius * (1 - 2 * share)), share, apart(kCount) + kRadius)
            << share;
    }
  }
}

TEST(MeshSamples, AreAFunctionOfTheSeed) {
  const Mesh mesh = tube(0.1);
  for (const PointSet points : kSets) {
    const Samples samples = mesh_samples(mesh, {100, points, 3});
    EXPECT_EQ(samples, mesh_samples(mesh, {100, points, 3}));
    EXPECT_NE(samples, mesh_samples(mesh, {100, points, 4}));
    EXPECT_EQ(std::set(samples.begin(), samples.end()).size(), 100U);
  }
}

TEST(MeshLight, IsPlacedByItsSurfaces) {
  Scene parts;
  add(parts, box_mesh({0, 0, 0}, {1, 2, 3}));
  add(parts, plate_mesh(Plate{0, 0, 1, 1, 0}));
  parts.geometry[0].local_to_world = glm::dmat4(2.0);
  parts.geometry[0].local_to_world[3] = glm::dvec4(10, 0, 0, 1);
  parts.geometry[1].local_to_world[3] = glm::dvec4(8, 0, -2, 1);
  Light light = rect_light(1, 1);
  light.direction = {0, -1, 0};
  light.up = glm::dvec3(0, 0, 1);
  set_emitter(parts.geometry, light);
  // Bounds from (8, 0, -2) to (12, 4, 6).
  EXPECT_EQ(light.position, glm::dvec3(10, 2, 2));
  EXPECT_EQ(half_box(light), (std::array<double, 3>{2, 4, 2}));
  const Mesh& mesh = *std::get<MeshLight>(light.shape).mesh;
  EXPECT_FALSE(mesh.closed);
  EXPECT_EQ(mesh.triangles.size(), parts.geometry[0].mesh->triangles.size() + 2);
  const RigidTransform to_world = inverse(light_frame(light));
  const glm::dvec3 corner = apply(to_world, glm::dvec3(mesh.positions.back()));
  EXPECT_LT(glm::length(corner - glm::dvec3(8, 1, -2)), 1e-6);
}

TEST(MeshLight, TheShareOfATubeThatAnEdgeHides) {
  // Edges across the tube before and behind it, and to one side.
  constexpr std::uint32_t kSamples = 256;
  Scene scene;
  add(scene, Plate{0.2, -4, 4, 4, 1.5});
  add(scene, Plate{-4, -4, -0.1, 4, -1.2});
  add(scene, quad_mesh({0.3, 1.4, -4}, {4, 1.4, -4}, {4, 1.4, 4}, {0.3, 1.4, 4}));
  Light light = mesh_light(tube(0.01));
  light.far_depth = 3;
  BakeOptions options = small_options(96, 96, kSamples);
  options.epsilon = 0.005;
  options.receivers = Receivers::all;
  const BakedFunctions baked(scene, light, options);
  ASSERT_EQ(baked.map().views.size(), 6U);
  const PenumbraLookUp look_up(baked.map());
  // One stratum along the tube is cut; the tube is 0.01 thick, seen past the edge.
  const double slack = options.epsilon + 4.0 / kSamples + 0.01;
  const double texel = 2.0 / 94;
  int penumbra = 0;
  for (int n = 0; n < 120; ++n) {
    const double x = 1.6 * (n / 120.0 - 0.5);
    const auto check = [&](const glm::dvec3& p, double away, double edge_away, double edge, bool is_beyond) {
      const auto truth = [&](double moved) {
        const double hidden = rect_half_plane(2, back_project(edge, edge_away, (p.x + moved) / away, away));
        return is_beyond ? hidden : 1 - hidden;
      };
      const double moved = 2 * texel * away, a = truth(-moved), b = truth(moved);
      const double value = static_cast<double>(look_up.at({p.x, p.y, p.z}, Filter::bilinear).attenuation);
      EXPECT_GE(value, std::min(a, b) - slack) << p.x << " " << p.y << " " << p.z;
      EXPECT_LE(value, std::max(a, b) + slack) << p.x << " " << p.y << " " << p.z;
      penumbra += truth(0) > 0.2 && truth(0) < 0.8 ? 1 : 0;
    };
    check({x, 0.1, 2.5}, 2.5, 1.5, 0.2, true);
    check({x, -0.2, -2.4}, 2.4, 1.2, -0.1, false);
    check({x, 2.6, 0.1}, 2.6, 1.4, 0.3, true);
  }
  EXPECT_GT(penumbra, 60);
}

TEST(MeshLight, RefusesWhatIsNone) {
  const auto fault = [](const Light& light) -> std::string {
    try {
      static_cast<void>(bake({}, light, small_options(16, 16, 4)));
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      return error.what();
    }
    return "";
  };
  Light light = rect_light(1, 1);
  light.shape = MeshLight{};
  EXPECT_EQ(fault(light), light.name + ".mesh: is missing");
  EXPECT_EQ(fault(mesh_light({})), light.name + ".mesh: has no area");
  Mesh mesh = plate_mesh(Plate{0, 0, 1, 1, 0});
  EXPECT_EQ(fault(mesh_light(mesh)), "");
  mesh.triangles[0].x = 9;
  EXPECT_EQ(fault(mesh_light(mesh)), light.name + ".mesh: must have indices of its positions");
  mesh.positions[0].x = NAN;
  EXPECT_EQ(fault(mesh_light(mesh)), light.name + ".mesh: must have finite positions");
}

}  // namespace
}  // namespace pdsm::test
