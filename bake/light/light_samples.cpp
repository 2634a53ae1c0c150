// SPDX-License-Identifier: Apache-2.0
// Point sets on planar lights, in spheres and of directions to distant ones, and the sub-texel jitter of each
// sample's map.
//
// Fibonacci lattice: Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, 1992.
// Uniform points of the unit 3-sphere: Marsaglia, Choosing a Point from the Surface of a Sphere, 1972.
// Sunflower: Vogel, A better way to construct the sunflower head, 1979.
// Concentric map: Shirley, Chiu, A Low Distortion Map Between Disk and Square, 1997.
// R2 sequence: Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "light/emission_warp.h"
#include "pdsm/bake/bake.h"

namespace pdsm {
namespace {

using Point2 = std::array<double, 2>;

constexpr double kInverseGoldenRatio = 0.61803398874989484820;
// Powers of the inverse plastic number, the two-dimensional counterpart of the golden ratio.
constexpr double kInversePlastic = 0.75487766624669276;
constexpr double kInversePlasticSquared = 0.56984029099805327;

double fraction(double x) {
  return x - std::floor(x);
}

/// Uniform in [0, 1), a pure function of its arguments (SplitMix64's finaliser, twice).
double hash_uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15u + index * 0xD1B54A32D192ED03u + dimension;
  for (int round = 0; round < 2; ++round) {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    x ^= x >> 31;
  }
  return static_cast<double>(x >> 11) * 0x1.0p-53;
}

/// Shift of a point set that a seed selects; seed 0 shifts nothing.
double seed_shift(std::uint64_t seed, std::uint64_t dimension) {
  return seed == 0 ? 0.0 : hash_uniform(seed, 0, dimension);
}

Point2 lattice_point(std::uint32_t i, std::uint32_t count, std::uint64_t seed) {
  return {fraction((i + 0.5) / count + seed_shift(seed, 2)),
          fraction(0.5 + i * kInverseGoldenRatio + seed_shift(seed, 3))};
}

/// Point i of `count` in rows of near-equal strata of equal area: exactly n x n strata for count = n².
/// Row r holds the points floor(r count / rows) .. floor((r + 1) count / rows) - 1 and is as high as they
/// are many, so every stratum has area 1 / count.
Point2 jittered_point(std::uint32_t i, std::uint32_t count, std::uint32_t rows, std::uint64_t seed) {
  const std::uint64_t n = count;
  std::uint64_t row = (std::uint64_t{i} * rows) / n;
  while ((row + 1) * n / rows <= i) ++row;
  const std::uint64_t begin = row * n / rows, end = (row + 1) * n / rows;
  const double x =
      (static_cast<double>(i - begin) + hash_uniform(seed, i, 0)) / static_cast<double>(end - begin);
  const double y =
      (static_cast<double>(begin) + static_cast<double>(end - begin) * hash_uniform(seed, i, 1)) /
      static_cast<double>(n);
  return {x, y};
}

Point2 concentric_disk(const Point2& square) {
  const double a = 2 * square[0] - 1, b = 2 * square[1] - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b;
  const double phi =
      wide ? std::numbers::pi / 4 * (b / a) : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

Point2 sunflower(std::uint32_t i, std::uint32_t count, std::uint64_t seed) {
  const double r = std::sqrt((i + 0.5) / count);
  const double phi = 2 * std::numbers::pi * (i * kInverseGoldenRatio + seed_shift(seed, 2));
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Strata rows for a stratified set on a rectangle; a line light is stratified along its line alone.
std::uint32_t strata_rows(const RectLight& light, std::uint32_t count) {
  if (light.height == 0) return 1;
  if (light.width == 0) return count;
  return static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(count))));
}

/// A point of the unit square that stands for the light's face.
Point2 rect_point(const RectLight& light, std::uint32_t i, std::uint32_t count, PointSet points,
                  std::uint64_t seed) {
  const Point2 p = points == PointSet::lattice ? lattice_point(i, count, seed)
                                               : jittered_point(i, count, strata_rows(light, count), seed);
  // A line along y takes the lattice's even coordinate.
  const bool swap = points == PointSet::lattice && light.width == 0;
  return {p[0], p[swap ? 0 : 1]};
}

Point2 on_face(const RectLight& light, const Point2& unit) {
  return {(unit[0] - 0.5) * light.width, (unit[1] - 0.5) * light.height};
}

Point2 sample_shape(const RectLight& light, std::uint32_t i, std::uint32_t count, PointSet points,
                    std::uint64_t seed) {
  return on_face(light, rect_point(light, i, count, points, seed));
}

Point2 sample_shape(const DiskLight& light, std::uint32_t i, std::uint32_t count, PointSet points,
                    std::uint64_t seed) {
  const auto rows = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(count))));
  const Point2 p = points == PointSet::lattice ? sunflower(i, count, seed)
                                               : concentric_disk(jittered_point(i, count, rows, seed));
  return {p[0] * light.radius, p[1] * light.radius};
}

/// Tangents of directions, uniform over the solid angle of the light's disk. A share k of the disk lies
/// within the angle t of its centre with sin(t/2)^2 = k sin(angle/4)^2; with k = |p|^2 for points p of the
/// unit disk, tan t = 2 sin(t/2) cos(t/2) / (1 - 2 sin(t/2)^2) is |p| times what follows.
Point2 sample_shape(const DistantLight& light, std::uint32_t i, std::uint32_t count, PointSet points,
                    std::uint64_t seed) {
  const Point2 p = sample_shape(DiskLight{1}, i, count, points, seed);
  const double sine = std::sin(light.angle / 4 * (std::numbers::pi / 180));
  const double squared = (p[0] * p[0] + p[1] * p[1]) * sine * sine;
  const double scale = 2 * sine * std::sqrt(1 - squared) / (1 - 2 * squared);
  return {p[0] * scale, p[1] * scale};
}

/// Points of the unit ball with density 1 / sqrt(1 - rho^2), whose projections to any plane are uniform on
/// its disk (docs/maths.md, "Sphere lights"): uniform points of the unit sphere in four dimensions, the last
/// coordinate dropped. Those are (sqrt(a) e^(2 pi i b), sqrt(1 - a) e^(2 pi i c)) of a point (a, b, c) of the
/// unit cube.
std::array<double, 3> ball_point(std::uint32_t i, std::uint32_t count, PointSet points, std::uint64_t seed) {
  double a = fraction((i + 0.5) / count + seed_shift(seed, 2)),
         b = fraction(i * kInversePlastic + seed_shift(seed, 3)),
         c = fraction(i * kInversePlasticSquared + seed_shift(seed, 6));
  if (points == PointSet::jittered) {
    a = (i + hash_uniform(seed, i, 0)) / count;
    b = hash_uniform(seed, i, 1);
    c = hash_uniform(seed, i, 7);
  }
  const double angle = 2 * std::numbers::pi * b;
  return {std::sqrt(a) * std::cos(angle), std::sqrt(a) * std::sin(angle),
          std::sqrt(1 - a) * std::cos(2 * std::numbers::pi * c)};
}

std::array<double, 3> sample_sphere(const SphereLight& light, std::uint32_t i, std::uint32_t count,
                                    PointSet points, std::uint64_t seed) {
  if (count == 1) return {0, 0, 0};
  const auto p = ball_point(i, count, points, seed);
  return {p[0] * light.radius, p[1] * light.radius, p[2] * light.radius};
}

/// One sample stands for the whole light at its centre.
std::array<double, 3> sample_light(const LightShape& any_shape, std::uint32_t i, std::uint32_t count,
                                   PointSet points, std::uint64_t seed) {
  if (const auto* sphere = std::get_if<SphereLight>(&any_shape))
    return sample_sphere(*sphere, i, count, points, seed);
  const auto* sun = std::get_if<DistantLight>(&any_shape);
  const double z = sun != nullptr ? 1.0 : 0.0;
  if (count == 1) return {0, 0, z};
  const auto* rect = std::get_if<RectLight>(&any_shape);
  const Point2 p = sun != nullptr    ? sample_shape(*sun, i, count, points, seed)
                   : rect != nullptr ? sample_shape(*rect, i, count, points, seed)
                                     : sample_shape(std::get<DiskLight>(any_shape), i, count, points, seed);
  return {p[0], p[1], z};
}

std::array<double, 3> sample_picture(const RectLight& light, const EmissionWarp& warp, std::uint32_t i,
                                     std::uint32_t count, PointSet points, std::uint64_t seed) {
  const Point2 p =
      on_face(light, warp(count == 1 ? Point2{0.5, 0.5} : rect_point(light, i, count, points, seed)));
  return {p[0], p[1], 0};
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
  std::optional<EmissionWarp> warp;
  if (light.emission) warp.emplace(*light.emission);
  for (std::uint32_t i = 0; i < count; ++i) {
    samples[i].position =
        warp ? sample_picture(std::get<RectLight>(light.shape), *warp, i, count, points, seed)
             : sample_light(light.shape, i, count, points, seed);
    samples[i].jitter = {map_jitter(i, kInversePlastic, seed, 4),
                         map_jitter(i, kInversePlasticSquared, seed, 5)};
    samples[i].weight = 1;
  }
  return samples;
}

}  // namespace pdsm
