// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "csv_table.h"
#include "pdsm/bake/scene_file.h"
#include "steps.h"
#include "timed_bake.h"

namespace pdsm::bench {
namespace {

/// The least of a few runs: what other work on the machine does to a run, it only adds.
constexpr int kRuns = 3;
/// Each value of a series over the one before.
constexpr double kStep = 4;

/// A torus of 2 n² triangles, waved so that no two of its faces are alike, around the origin of y up.
Mesh waved_torus(std::uint32_t n) {
  Mesh mesh;
  const auto angle = [n](std::uint32_t i) { return 2 * std::numbers::pi * i / n; };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double a = angle(i), b = angle(j), r = 0.7 + 0.05 * std::sin(9 * a + 7 * b);
      mesh.positions.emplace_back((2 + r * std::cos(b)) * std::cos(a), r * std::sin(b),
                                  (2 + r * std::cos(b)) * std::sin(a));
      const std::uint32_t right = (i + 1) % n, up = (j + 1) % n;
      mesh.triangles.emplace_back(i * n + j, i * n + up, right * n + up);
      mesh.triangles.emplace_back(i * n + j, right * n + up, right * n + j);
    }
  }
  return mesh;
}

/// The scene with its casters that are not the ground replaced by a torus of about `triangles`.
Scene torus_scene(const Scene& dragon, std::uint32_t triangles) {
  Scene scene = dragon;
  Geometry& caster = scene.geometry.front();
  caster.mesh = std::make_shared<const Mesh>(
      waved_torus(static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 2.0)))));
  caster.local_to_world = glm::translate(glm::dmat4(1), glm::dvec3(0, 1.5, 0));
  return scene;
}

class Series {
 public:
  Series(const Folders& folders, CsvTable& table) : folders_(folders), table_(table) {}

  /// Adds a row of the least times of a bake.
  void measure(const char* varied, std::uint32_t value, const Scene& scene, const BakeOptions& options) {
    double seconds = 1e9, cpu_seconds = 1e9;
    for (int run = 0; run < kRuns; ++run) {
      const TimedBake timed = timed_bake(scene, only_light(scene), options, folders_.scenes);
      const double bvh = timed.baked.report.seconds_bvh;
      seconds = std::min(seconds, timed.seconds - bvh);
      cpu_seconds = std::min(cpu_seconds, timed.cpu_seconds - bvh * options.threads);
    }
    const bool follows = !table_.rows.empty() && table_.rows.back()[0] == varied;
    const double ratio = follows ? cpu_seconds / last_ : 0;
    table_.rows.push_back({varied, std::to_string(value), fmt::format("{:.3f}", seconds),
                           fmt::format("{:.3f}", cpu_seconds),
                           follows ? fmt::format("{:.2f}", std::log(ratio) / std::log(kStep)) : ""});
    last_ = cpu_seconds;
    tell(fmt::format("growth: {} {}", varied, value));
  }

 private:
  const Folders& folders_;
  CsvTable& table_;
  double last_ = 0;
};

}  // namespace

void measure_growth(const Folders& folders) {
  CsvTable table{{"varied", "value", "seconds", "cpu_seconds", "power"}, {}};
  Series series(folders, table);
  const Scene dragon = read_scene(folders.scenes / "dragon.scene.json");
  BakeOptions options;
  options.threads = 2;
  for (const std::uint32_t samples : {16U, 64U, 256U, 1024U}) {
    options.samples = samples;
    series.measure("samples", samples, dragon, options);
  }
  options.samples = 256;
  for (const std::uint32_t edge : {256U, 512U, 1024U, 2048U}) {
    options.width = options.height = edge;
    series.measure("texels", edge * edge, dragon, options);
  }
  options.width = options.height = 512;
  for (const std::uint32_t triangles : {20'000U, 80'000U, 320'000U, 1'280'000U})
    series.measure("triangles", triangles, torus_scene(dragon, triangles), options);
  write_csv(table, folders.results / "growth.csv");
}

}  // namespace pdsm::bench
