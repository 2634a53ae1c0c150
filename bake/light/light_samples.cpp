// SPDX-License-Identifier: Apache-2.0
// Points on planar lights, in spheres and meshes, and of directions to distant ones, and the sub-texel jitter
// of each sample's map.
//
// Uniform points of the unit 3-sphere: Marsaglia, Choosing a Point from the Surface of a Sphere, 1972.
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "light/disk_emission.h"
#include "light/emission_warp.h"
#include "light/mesh_samples.h"
#include "light/point_sets.h"
#include "pdsm/bake/bake.h"

namespace pdsm {
namespace {

using Point3 = std::array<double, 3>;

/// Makes the sample of each index.
using Sampler = std::function<Point3(std::uint32_t)>;

/// A point of the unit square that stands for the light's face. A line light is stratified along its line
/// alone.
Point2 rect_point(const RectLight& light, const SampleSet& set, std::uint32_t i) {
  if (set.points == PointSet::jittered) {
    const std::uint32_t rows = light.height == 0 ? 1 : light.width == 0 ? set.count : square_rows(set.count);
    return jittered_point(set, i, rows);
  }
  const Point2 p = lattice_point(set, i);
  // A line along y takes the lattice's even coordinate.
  return {p[0], p[light.width == 0 ? 0 : 1]};
}

Sampler sampler_of(const RectLight& light, const EmissionImage* picture, const SampleSet& set) {
  const auto on_face = [light](const Point2& unit) {
    return Point3{(unit[0] - 0.5) * light.width, (unit[1] - 0.5) * light.height, 0};
  };
  if (picture == nullptr) return [=](std::uint32_t i) { return on_face(rect_point(light, set, i)); };
  return [=, warp = EmissionWarp(*picture)](std::uint32_t i) {
    return on_face(warp(set.count == 1 ? Point2{0.5, 0.5} : rect_point(light, set, i)));
  };
}

Sampler sampler_of(const DiskLight& light, const EmissionImage* picture, const SampleSet& set) {
  const auto on_face = [light](const Point2& p) {
    return Point3{p[0] * light.radius, p[1] * light.radius, 0};
  };
  if (picture == nullptr) return [=](std::uint32_t i) { return on_face(disk_point(set, i)); };
  return [=, warp = DiskEmissionWarp(*picture)](std::uint32_t i) {
    return on_face(warp(set.count == 1 ? Point2{0.5, 0.5} : square_point(set, i)));
  };
}

/// Tangents of directions, uniform over the solid angle of the light's disk. A share k of the disk lies
/// within the angle t of its centre with sin(t/2)^2 = k sin(angle/4)^2; with k = |p|^2 for points p of the
/// unit disk, tan t = 2 sin(t/2) cos(t/2) / (1 - 2 sin(t/2)^2) is |p| times what follows.
Point3 sun_point(const DistantLight& light, const SampleSet& set, std::uint32_t i) {
  const Point2 p = disk_point(set, i);
  const double sine = std::sin(light.angle / 4 * (std::numbers::pi / 180));
  const double squared = (p[0] * p[0] + p[1] * p[1]) * sine * sine;
  const double scale = 2 * sine * std::sqrt(1 - squared) / (1 - 2 * squared);
  return {p[0] * scale, p[1] * scale, 1};
}

Sampler sampler_of(const DistantLight& light, const EmissionImage*, const SampleSet& set) {
  return [=](std::uint32_t i) { return sun_point(light, set, i); };
}

/// Points of the unit ball with density 1 / sqrt(1 - rho^2), whose projections to any plane are uniform on
/// its disk (docs/maths.md, "Sphere lights"): uniform points of the unit sphere in four dimensions, the last
/// coordinate dropped. Those are (sqrt(a) e^(2 pi i b), sqrt(1 - a) e^(2 pi i c)) of a point (a, b, c) of the
/// unit cube.
Point3 ball_point(const SampleSet& set, std::uint32_t i) {
  double a = fraction((i + 0.5) / set.count + seed_shift(set.seed, 2)),
         b = fraction(i * kInversePlastic + seed_shift(set.seed, 3)),
         c = fraction(i * kInversePlasticSquared + seed_shift(set.seed, 6));
  if (set.points == PointSet::jittered) {
    a = (i + hash_uniform(set.seed, i, 0)) / set.count;
    b = hash_uniform(set.seed, i, 1);
    c = hash_uniform(set.seed, i, 7);
  }
  const double angle = 2 * std::numbers::pi * b;
  return {std::sqrt(a) * std::cos(angle), std::sqrt(a) * std::sin(angle),
          std::sqrt(1 - a) * std::cos(2 * std::numbers::pi * c)};
}

Sampler sampler_of(const SphereLight& light, const EmissionImage*, const SampleSet& set) {
  return [=](std::uint32_t i) {
    const Point3 p = ball_point(set, i);
    return Point3{p[0] * light.radius, p[1] * light.radius, p[2] * light.radius};
  };
}

Sampler sampler_of(const MeshLight& light, const EmissionImage*, const SampleSet& set) {
  return [samples = mesh_samples(*light.mesh, set)](std::uint32_t i) { return samples[i]; };
}

/// One sample stands for the whole light at its centre, or at that of what a picture emits.
Sampler make_sampler(const Light& light, const SampleSet& set) {
  if (set.count == 1 && !light.emission)
    return [z = is_distant(light) ? 1.0 : 0.0](std::uint32_t) { return Point3{0, 0, z}; };
  return std::visit([&](const auto& shape) { return sampler_of(shape, light.emission.get(), set); },
                    light.shape);
}

/// In [-0.5, 0.5), 0 for the first sample of seed 0.
float map_jitter(std::uint32_t i, double alpha, std::uint64_t seed, std::uint64_t dimension) {
  const auto jitter = static_cast<float>(fraction(0.5 + i * alpha + seed_shift(seed, dimension)) - 0.5);
  return jitter < 0.5F ? jitter : -0.5F;
}

}  // namespace

std::vector<LightSample> make_light_samples(const Light& light, std::uint32_t count, PointSet points,
                                            std::uint64_t seed) {
  assert(count >= 1);
  std::vector<LightSample> samples(count);
  const Sampler sample = make_sampler(light, {count, points, seed});
  for (std::uint32_t i = 0; i < count; ++i) {
    samples[i].position = sample(i);
    samples[i].jitter = {map_jitter(i, kInversePlastic, seed, 4),
                         map_jitter(i, kInversePlasticSquared, seed, 5)};
    samples[i].weight = 1;
  }
  return samples;
}

}  // namespace pdsm
