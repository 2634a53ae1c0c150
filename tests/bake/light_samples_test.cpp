// SPDX-License-Identifier: Apache-2.0
// Point sets on lights (numerics.md section 3).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "pdsm/bake/bake.h"
#include "support/exact_truth.h"
#include "support/random.h"

namespace pdsm::test {
namespace {

/// A line across the unit square or the disk of radius 1/2: the half plane beyond distance t, normal theta.
struct Line {
  double theta, t;
};

std::vector<Line> random_lines(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Line> lines;
  for (int n = 0; n < count; ++n)
    lines.push_back({random.uniform(0, 2 * std::numbers::pi), random.uniform(-0.7, 0.7)});
  return lines;
}

double share_beyond(const std::vector<LightSample>& samples, const Line& line) {
  std::size_t beyond = 0;
  for (const LightSample& s : samples) {
    beyond += std::cos(line.theta) * s.position[0] + std::sin(line.theta) * s.position[1] >= line.t ? 1 : 0;
  }
  return static_cast<double>(beyond) / static_cast<double>(samples.size());
}

struct LineErrors {
  double mean = 0, worst = 0;
};

LineErrors square_errors(const std::vector<LightSample>& samples, const std::vector<Line>& lines) {
  LineErrors errors;
  for (const Line& line : lines) {
    const double error = std::abs(share_beyond(samples, line) - square_half_plane(1, line.theta, line.t));
    errors.mean += error / static_cast<double>(lines.size());
    errors.worst = std::max(errors.worst, error);
  }
  return errors;
}

LineErrors disk_errors(const std::vector<LightSample>& samples, const std::vector<Line>& lines) {
  LineErrors errors;
  for (const Line& line : lines) {
    const double error = std::abs(share_beyond(samples, line) - disk_half_plane(0.5, line.t));
    errors.mean += error / static_cast<double>(lines.size());
    errors.worst = std::max(errors.worst, error);
  }
  return errors;
}

TEST(SamplingTolerance, IsThatOfTheTable) {
  EXPECT_NEAR(sampling_tolerance(edge_strata(64), 64), 0.163, 0.0005);
  EXPECT_NEAR(sampling_tolerance(edge_strata(256), 256), 0.0586, 0.00005);
  EXPECT_NEAR(sampling_tolerance(edge_strata(1024), 1024), 0.0209, 0.00005);
  EXPECT_NEAR(sampling_tolerance(edge_strata(4096), 4096), 0.0074, 0.00005);
}

/// One edge crosses K <= 2 n - 1 of n x n strata; every other holds its share exactly.
TEST(JitteredSamples, ErrAtMostByTheStrataCrossed) {
  for (std::uint32_t n = 1; n <= 32; ++n) {
    const auto samples = make_light_samples(rect_light(1, 1), n * n, PointSet::jittered, n);
    const double certain = (2.0 * n - 1) / (n * n);
    for (const Line& line : random_lines(n, 300)) {
      const double error = std::abs(share_beyond(samples, line) - square_half_plane(1, line.theta, line.t));
      ASSERT_LE(error, certain + 1e-12) << "n " << n << ", theta " << line.theta << ", t " << line.t;
    }
  }
}

TEST(JitteredSamples, ErrWithinTheProbableBound) {
  for (const std::uint32_t count : {64u, 256u, 1024u, 4096u}) {
    const LineErrors errors = square_errors(
        make_light_samples(rect_light(1, 1), count, PointSet::jittered, 1), random_lines(81, 4000));
    EXPECT_LE(errors.worst, sampling_tolerance(edge_strata(count), count)) << count;
  }
}

/// Other counts: r rows of c or c + 1 strata of equal area. A line crosses each row's borders once and at
/// most c + 1 columns, which may be offset in each row.
TEST(JitteredSamples, ErrLittleForAnyCount) {
  for (std::uint32_t count = 2; count <= 300; count += 7) {
    const double rows = std::round(std::sqrt(count)), columns = std::ceil(count / rows);
    const auto samples = make_light_samples(rect_light(1, 1), count, PointSet::jittered, count);
    for (const Line& line : random_lines(count, 200)) {
      const double error = std::abs(share_beyond(samples, line) - square_half_plane(1, line.theta, line.t));
      ASSERT_LE(error, (2 * rows + columns) / count + 1e-12) << "N " << count;
    }
  }
}

TEST(JitteredSamples, FillEachStratumOnce) {
  for (std::uint32_t n = 1; n <= 20; ++n) {
    std::set<std::pair<int, int>> strata;
    for (const LightSample& s : make_light_samples(rect_light(1, 1), n * n, PointSet::jittered, 2)) {
      if (n == 1) continue;
      strata.emplace(static_cast<int>((s.position[0] + 0.5) * n),
                     static_cast<int>((s.position[1] + 0.5) * n));
    }
    EXPECT_EQ(strata.size(), n == 1 ? 0u : n * n) << n;
  }
}

/// The exact-truth tests allow lattices what jitter may err: here is why they may.
TEST(LatticeSamples, AreNoWorseThanJitteredOnes) {
  const std::vector<Line> lines = random_lines(82, 4000);
  for (const std::uint32_t count : {64u, 256u, 1024u}) {
    double jittered_square = 0, jittered_disk = 0;
    constexpr int kSeeds = 5;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      jittered_square +=
          square_errors(make_light_samples(rect_light(1, 1), count, PointSet::jittered, seed), lines).mean /
          kSeeds;
      jittered_disk +=
          disk_errors(make_light_samples(disk_light(0.5), count, PointSet::jittered, seed), lines).mean /
          kSeeds;
    }
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
      const LineErrors square =
          square_errors(make_light_samples(rect_light(1, 1), count, PointSet::lattice, seed), lines);
      const LineErrors disk =
          disk_errors(make_light_samples(disk_light(0.5), count, PointSet::lattice, seed), lines);
      EXPECT_LE(square.mean, jittered_square) << count << ", seed " << seed;
      EXPECT_LE(disk.mean, jittered_disk) << count << ", seed " << seed;
      EXPECT_LE(square.worst, sampling_tolerance(edge_strata(count), count)) << count << ", seed " << seed;
      EXPECT_LE(disk.worst, sampling_tolerance(edge_strata(count), count)) << count << ", seed " << seed;
    }
  }
}

/// The share of directions within an angle of a distant light's centre is that of the solid angles: exactly
/// what the same points of the disk have within the radius that bounds as large a share.
TEST(DistantSamples, AreUniformOverTheSolidAngle) {
  for (const PointSet points : {PointSet::lattice, PointSet::jittered}) {
    const auto disk = make_light_samples(disk_light(1), 256, points, 1);
    for (const double angle : {0.53, 90.0}) {
      const auto samples = make_light_samples(distant_light(angle), 256, points, 1);
      const double half = angle / 2 * std::numbers::pi / 180;
      for (std::size_t n = 0; n < samples.size(); ++n) {
        const auto &d = samples[n].position, &p = disk[n].position;
        EXPECT_EQ(d[2], 1);
        EXPECT_EQ(samples[n].weight, 1);
        EXPECT_EQ(samples[n].jitter, disk[n].jitter);
        const double cosine = 1 / std::sqrt(1 + d[0] * d[0] + d[1] * d[1]);
        // 1 - cos loses digits: 2^-53 of 1 - cos(half).
        EXPECT_NEAR((1 - cosine) / (1 - std::cos(half)), p[0] * p[0] + p[1] * p[1], 1e-10);
        EXPECT_NEAR(std::atan2(d[1], d[0]), std::atan2(p[1], p[0]), 1e-12);
      }
    }
    for (const LightSample& s : make_light_samples(distant_light(0), 16, points, 1))
      EXPECT_EQ(s.position, (std::array<double, 3>{0, 0, 1}));
  }
}

struct Set {
  bool disk;
  PointSet points;
  std::uint64_t seed;
};

class AnyCount : public testing::TestWithParam<Set> {};

TEST_P(AnyCount, GivesAsManySamplesWithinTheLight) {
  const auto [disk, points, seed] = GetParam();
  const Light light = disk ? disk_light(0.7) : rect_light(3, 0.5);
  for (std::uint32_t count = 1; count <= 300; ++count) {
    const auto samples = make_light_samples(light, count, points, seed);
    ASSERT_EQ(samples.size(), count);
    std::set<std::array<double, 3>> distinct;
    for (const LightSample& s : samples) {
      distinct.insert(s.position);
      ASSERT_EQ(s.position[2], 0);
      ASSERT_EQ(s.weight, 1.0F);
      // A disk's points come from sine and cosine: 2^-50 for their rounding.
      const bool inside = disk ? std::hypot(s.position[0], s.position[1]) <= 0.7 * (1 + 0x1.0p-50)
                               : std::abs(s.position[0]) <= 1.5 && std::abs(s.position[1]) <= 0.25;
      ASSERT_TRUE(inside) << "N " << count << ": " << s.position[0] << ", " << s.position[1];
      for (const float jitter : s.jitter) ASSERT_TRUE(jitter >= -0.5F && jitter < 0.5F) << jitter;
    }
    ASSERT_EQ(distinct.size(), count);
  }
}

TEST_P(AnyCount, OfOneIsTheCentre) {
  const auto [disk, points, seed] = GetParam();
  const auto samples = make_light_samples(disk ? disk_light(0.7) : rect_light(3, 0.5), 1, points, seed);
  EXPECT_EQ(samples[0].position, (std::array<double, 3>{0, 0, 0}));
}

TEST_P(AnyCount, SeedsAreReproducibleAndDiffer) {
  const auto [disk, points, seed] = GetParam();
  const Light light = disk ? disk_light(0.7) : rect_light(3, 0.5);
  const auto first = make_light_samples(light, 100, points, seed);
  EXPECT_EQ(first, make_light_samples(light, 100, points, seed));
  const auto other = make_light_samples(light, 100, points, seed + 1);
  std::size_t moved = 0, jittered = 0;
  for (std::size_t n = 0; n < 100; ++n) {
    moved += first[n].position != other[n].position ? 1 : 0;
    jittered += first[n].jitter != other[n].jitter ? 1 : 0;
  }
  EXPECT_EQ(moved, 100u);
  EXPECT_EQ(jittered, 100u);
}

INSTANTIATE_TEST_SUITE_P(EverySet, AnyCount,
                         testing::Values(Set{false, PointSet::lattice, 0}, Set{false, PointSet::lattice, 9},
                                         Set{false, PointSet::jittered, 0}, Set{true, PointSet::lattice, 0},
                                         Set{true, PointSet::lattice, 9}, Set{true, PointSet::jittered, 4}));

/// The first sample of seed 0 has no jitter: a bake with N = 1 is the plain shadow map.
TEST(MapJitter, OfTheFirstSampleIsNone) {
  for (const std::uint32_t count : {1u, 100u}) {
    EXPECT_EQ(make_light_samples(rect_light(1, 1), count, PointSet::lattice, 0)[0].jitter,
              (std::array<float, 2>{0, 0}));
  }
}

/// The jitters of a map's samples fill a texel evenly: of 1024 in each of 8 x 8 parts 16, give or take half.
/// (R2 has discrepancy below 8 / N, so 1/64 +- 1/128.)
TEST(MapJitter, FillsTheTexel) {
  int parts[8][8] = {};
  for (const LightSample& s : make_light_samples(rect_light(1, 1), 1024, PointSet::lattice, 0)) {
    ++parts[static_cast<int>((s.jitter[1] + 0.5F) * 8)][static_cast<int>((s.jitter[0] + 0.5F) * 8)];
  }
  for (const auto& row : parts) {
    for (const int count : row) {
      EXPECT_GE(count, 8);
      EXPECT_LE(count, 24);
    }
  }
}

/// A line light is stratified along its line: each of N equal parts holds one sample.
TEST(LineLights, AreStratifiedAlongTheirLine) {
  for (const bool along_x : {true, false}) {
    const Light light = along_x ? rect_light(2, 0) : rect_light(0, 2);
    for (const PointSet points : {PointSet::lattice, PointSet::jittered}) {
      for (std::uint32_t count = 2; count <= 120; ++count) {
        std::set<int> parts;
        for (const LightSample& s : make_light_samples(light, count, points, 0)) {
          ASSERT_EQ(s.position[along_x ? 1 : 0], 0);
          parts.insert(static_cast<int>((s.position[along_x ? 0 : 1] / 2 + 0.5) * count));
        }
        ASSERT_EQ(parts.size(), count) << (along_x ? "x" : "y");
        ASSERT_GE(*parts.begin(), 0);
        ASSERT_LT(*parts.rbegin(), static_cast<int>(count));
      }
    }
  }
}

TEST(PointLights, HaveAllSamplesInTheirPoint) {
  for (const Light& light : {rect_light(0, 0), disk_light(0)}) {
    for (const LightSample& s : make_light_samples(light, 20, PointSet::lattice, 0)) {
      EXPECT_EQ(s.position, (std::array<double, 3>{0, 0, 0}));
    }
  }
}

}  // namespace
}  // namespace pdsm::test
