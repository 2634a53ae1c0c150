// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "csv_table.h"
#include "pdsm/bake/scene_file.h"
#include "steps.h"
#include "thesis.h"
#include "timed_bake.h"

namespace pdsm::bench {
namespace {

BakeOptions square(std::uint32_t samples, std::uint32_t edge, double epsilon) {
  BakeOptions options;
  options.samples = samples;
  options.width = options.height = edge;
  options.epsilon = epsilon;
  return options;
}

std::vector<std::string> time_row(const char* table, const std::string& value, const BakeOptions& options,
                                  const TimedBake& timed) {
  const BakeReport& report = timed.baked.report;
  return {table,
          value,
          std::to_string(options.samples),
          std::to_string(options.width),
          fmt::format("{:.3f}", timed.seconds),
          fmt::format("{:.3f}", timed.cpu_seconds),
          std::to_string(report.rays),
          std::to_string(report.events)};
}

Light square_light(Light light, double side) {
  light.shape = RectLight{side, side};
  return light;
}

}  // namespace

void measure_sizes(const Folders& folders) {
  CsvTable table{{"scene", "samples", "epsilon", "file_bytes", "gpu_bytes", "pieces"}, {}};
  for (const char* name : {"dragon", "level"}) {
    const Scene scene = read_scene(folders.scenes / (std::string(name) + ".scene.json"));
    for (const std::uint32_t samples : thesis::kSamples) {
      for (const double epsilon : thesis::kEpsilons) {
        const TimedBake timed =
            timed_bake(scene, only_light(scene), square(samples, 512, epsilon), folders.scenes);
        table.rows.push_back({name, std::to_string(samples), fmt::format("{}", epsilon),
                              std::to_string(timed.file_bytes), std::to_string(timed.gpu_bytes),
                              std::to_string(timed.baked.report.pieces)});
      }
      tell(fmt::format("sizes: {}, {} samples", name, samples));
    }
  }
  write_csv(table, folders.results / "size.csv");
}

void measure_times(const Folders& folders) {
  CsvTable table{{"varied", "value", "samples", "resolution", "seconds", "cpu_seconds", "rays", "events"},
                 {}};
  const Scene scene = read_scene(folders.scenes / "dragon.scene.json");
  const Light& light = only_light(scene);
  const auto measure = [&](const char* varied, std::uint32_t value, const Light& of,
                           const BakeOptions& options) {
    const TimedBake timed = timed_bake(scene, of, options, folders.scenes);
    table.rows.push_back(time_row(varied, std::to_string(value), options, timed));
    tell(fmt::format("times: {} {}, {} samples", varied, value, options.samples));
  };
  for (const std::uint32_t samples : thesis::kSamples) {
    for (const std::uint32_t edge : thesis::kResolutions) {
      BakeOptions options = square(samples, edge, 0.02);
      options.map_width = options.map_height = 512;
      measure("resolution", edge, light, options);
    }
  }
  for (const std::uint32_t edge : thesis::kMapResolutions) {
    BakeOptions options = square(256, 512, 0.02);
    options.map_width = options.map_height = edge;
    measure("map", edge, light, options);
  }
  for (const std::uint32_t side : thesis::kLightSizes)
    measure("light", side, square_light(light, side), square(256, 512, 0.02));
  write_csv(table, folders.results / "time.csv");
}

void measure_threads(const Folders& folders) {
  // The least of a few runs: what other work on the machine does to a run, it only adds.
  constexpr int kRuns = 3;
  CsvTable table{{"samples", "threads", "seconds", "cpu_seconds"}, {}};
  const Scene scene = read_scene(folders.scenes / "dragon.scene.json");
  for (const std::uint32_t samples : thesis::kSamples) {
    for (const std::uint32_t threads : {1U, 2U}) {
      BakeOptions options = square(samples, 512, 0.02);
      options.threads = threads;
      double seconds = 1e9, cpu_seconds = 1e9;
      for (int run = 0; run < kRuns; ++run) {
        const TimedBake timed = timed_bake(scene, only_light(scene), options, folders.scenes);
        seconds = std::min(seconds, timed.seconds);
        cpu_seconds = std::min(cpu_seconds, timed.cpu_seconds);
      }
      table.rows.push_back({std::to_string(samples), std::to_string(threads), fmt::format("{:.3f}", seconds),
                            fmt::format("{:.3f}", cpu_seconds)});
      tell(fmt::format("threads: {} samples, {}", samples, threads));
    }
  }
  write_csv(table, folders.results / "threads.csv");
}

}  // namespace pdsm::bench
