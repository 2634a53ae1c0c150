// SPDX-License-Identifier: Apache-2.0
// Marches through random densities against fine sums.
#include "trace/volume_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"
#include "support/scenes.h"
#include "support/volumes.h"

namespace pdsm::test {
namespace {

/// The density at a point in index coordinates, as its definition has it.
double density_at(const DensityGrid& grid, const glm::dvec3& p) {
  const glm::ivec3 cell(glm::floor(p));
  const glm::dvec3 w = p - glm::dvec3(cell);
  double sum = 0;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 corner = cell + glm::ivec3(n & 1, n / 2 & 1, n / 4);
    for (const DensityBrick& brick : grid.bricks) {
      const glm::ivec3 at = corner - brick.first;
      if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThan(at, glm::ivec3(7))))
        continue;
      sum += ((n & 1) != 0 ? w.x : 1 - w.x) * ((n / 2 & 1) != 0 ? w.y : 1 - w.y) *
             (n / 4 != 0 ? w.z : 1 - w.z) *
             static_cast<double>(brick.density[DensityBrick::at(at.x, at.y, at.z)]);
    }
  }
  return sum;
}

/// Noise at every voxel is the worst there is: a part of the march has one density for all of it. A part errs
/// by its greatest optical depth times what its density differs from its mean, 1/4 rms for noise between 0
/// and 1, so that over n parts the error is sqrt(n) / 4 of that, rms; no ray has more than 60 parts of full
/// depth. Where parts are looked at is random, and so there is no bias.
TEST(VolumeField, MarchesComeToTheIntegral) {
  Random random(11);
  Volume volume;
  volume.name = "noise";
  volume.grid = make_grid({-13, -3, 2}, {9, 12, 19}, [&](int x, int, int) {
    return x >= -7 && x < 1 ? 0.0 : random.uniform();  // a gap of a brick
  });
  volume.index_to_world = glm::dmat4(glm::dvec4(0.1, 0.02, 0, 0), glm::dvec4(0, 0.08, -0.01, 0),
                                     glm::dvec4(0.01, 0, 0.12, 0), glm::dvec4(0.3, 0.1, 1, 1));
  volume.extinction = 0.4;
  Scene scene;
  scene.volumes = {volume};
  const LightSpaceScene light_space = to_light_space(scene, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}});
  const VolumeField field(light_space.volumes.at(0));
  double squares = 0, bias = 0;
  constexpr int kRays = 300;
  for (int n = 0; n < kRays; ++n) {
    const CentralRay ray{{random.uniform(-1, 1), random.uniform(-1, 1), 0},
                         {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 1}};
    std::vector<MarchedPart> parts;
    const double end = random.uniform(1, 4);
    field.march(ray, 0.5, end, random.uniform(), parts);
    double marched = 0, before = 0.5;
    for (const MarchedPart& part : parts) {
      marched += part.optical_depth;
      ASSERT_GE(part.begin, before - 1e-12);
      ASSERT_LT(part.begin, part.end);
      before = part.end;
    }
    EXPECT_LE(before, end + 1e-12);
    double sum = 0;
    constexpr int kParts = 600;
    for (int k = 0; k < kParts; ++k) {
      const double t = 0.5 + (end - 0.5) * (k + 0.5) / kParts;
      sum += density_at(*volume.grid, glm::dvec3(light_space.volumes[0].light_to_index *
                                                 glm::dvec4(ray.origin + t * ray.direction, 1.0)));
    }
    const double exact = volume.extinction * glm::length(ray.direction) * (end - 0.5) / kParts * sum;
    squares += (marched - exact) * (marched - exact) / kRays;
    bias += (marched - exact) / kRays;
  }
  const double most = VolumeField::kPartDepth * std::sqrt(60.0) / 4;
  EXPECT_LT(std::sqrt(squares), most);
  EXPECT_LT(std::abs(bias), 5 * most / std::sqrt(kRays));
}

}  // namespace
}  // namespace pdsm::test
