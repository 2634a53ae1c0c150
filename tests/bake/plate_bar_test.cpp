// SPDX-License-Identifier: Apache-2.0
// The bar that the project set itself: a plate under a rectangle light, all defaults of quality on, looked up
// with the bilinear filter at any point, against the exact answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "pdsm/runtime/look_up.h"
#include "support/baked_functions.h"
#include "support/exact_truth.h"
#include "support/random.h"

namespace pdsm::test {
namespace {

constexpr double kLightHeight = 6;
/// In light space: the floor at depth 6, the plate 2.5 above it.
constexpr Plate kPlate{-0.4, -0.5, 0.8, 0.3, 3.5};

/// Light space to world: the light looks down from 6, its x is the world's and its y the world's z.
std::array<double, 3> to_world(double x, double y, double z) {
  return {x, kLightHeight - z, y};
}

Mesh world_plate(const Plate& p) {
  const auto at = [&](double x, double y) {
    const auto w = to_world(x, y, p.z);
    return glm::dvec3(w[0], w[1], w[2]);
  };
  return quad_mesh(at(p.x0, p.y0), at(p.x1, p.y0), at(p.x1, p.y1), at(p.x0, p.y1));
}

struct Errors {
  std::vector<double> absolute;
  std::size_t shadowed = 0;

  /// False shadow counts in full, lit points dilute nothing.
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (const double e : absolute) sum += e;
    return sum / static_cast<double>(shadowed);
  }
  [[nodiscard]] double percentile(double share) const {
    std::vector<double> sorted = absolute;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

TEST(PlateBar, MeanErrorIsBelowHalfAPercent) {
  Light light;
  light.name = "key";
  light.shape = RectLight{2, 1};
  light.position = {0, kLightHeight, 0};
  light.direction = {0, -1, 0};
  light.window = {-0.36, -0.28, 0.36, 0.28};
  Scene scene;
  add(scene, world_plate(kPlate));
  add(scene, world_plate({-10, -10, 10, 10, kLightHeight}));
  BakeOptions options;
  options.samples = 1024;
  options.epsilon = 0.01;
  options.threads = 2;
  const PenumbraMap map = decode_blocks(bake(scene, light, options));
  const PenumbraLookUp look_up(map);

  Random random(41);
  Errors errors, floor, free;
  for (int n = 0; n < 4000; ++n) {
    const bool on_floor = n % 2 == 0;
    // Free points lie anywhere in the domain, from the plate (near) on.
    const double z = on_floor ? kLightHeight * (1 - 1e-4) : random.uniform(kPlate.z, kLightHeight);
    const double x = z * random.uniform(-0.36, 0.36), y = z * random.uniform(-0.28, 0.28);
    const double truth = rect_plate(2, 1, kPlate, x, y, z);
    const double value = static_cast<double>(look_up.at(to_world(x, y, z), Filter::bilinear).attenuation);
    for (Errors* e : {&errors, on_floor ? &floor : &free}) {
      e->absolute.push_back(std::abs(value - truth));
      e->shadowed += truth > 0 ? 1 : 0;
    }
  }
  RecordProperty("mean_floor", std::to_string(floor.mean()));
  RecordProperty("mean_free", std::to_string(free.mean()));
  EXPECT_LE(errors.mean(), 0.005) << "floor " << floor.mean() << ", free " << free.mean();
  EXPECT_LE(errors.percentile(0.99), 0.02)
      << "floor " << floor.percentile(0.99) << ", free " << free.percentile(0.99);
  EXPECT_LE(floor.mean(), 0.005);
  EXPECT_LE(free.mean(), 0.005);
}

}  // namespace
}  // namespace pdsm::test
