// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "csv_table.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"
#include "steps.h"
#include "timed_bake.h"

namespace pdsm::bench {
namespace {

struct Bake {
  const char* scene;
  const char* light;
};
constexpr std::array<Bake, 5> kBakes{
    {{"plate", "key"}, {"dragon", "key"}, {"level", "key"}, {"courtyard", "key"}, {"courtyard", "lamp"}}};

const Light& light_of(const Scene& scene, const std::string& name) {
  for (const Light& light : scene.lights)
    if (light.name == name) return light;
  throw Error(Failure::input, scene.source, "has no light " + name);
}

/// What has a limit and is above it, a line each.
std::string list_worse(const CsvTable& counts, const CsvTable& limits) {
  std::string worse;
  for (std::size_t row = 0; row < limits.rows.size(); ++row) {
    const std::string scene = limits.cell(row, "scene"), light = limits.cell(row, "light");
    const std::size_t found = counts.find({{"scene", scene}, {"light", light}});
    for (std::size_t c = 2; c < limits.columns.size(); ++c) {
      const std::string& name = limits.columns[c];
      if (counts.number(found, name) <= limits.number(row, name)) continue;
      worse += fmt::format("\n{} {}: {} {}, the limit is {}", scene, light, name, counts.cell(found, name),
                           limits.cell(row, name));
    }
  }
  return worse;
}

}  // namespace

void measure_counts(const Folders& folders) {
  CsvTable table{{"scene", "light", "rays", "events", "pieces", "file_bytes", "gpu_bytes"}, {}};
  for (const Bake& each : kBakes) {
    const Scene scene = read_scene(folders.scenes / (std::string(each.scene) + ".scene.json"));
    const Light& light = light_of(scene, each.light);
    BakeOptions options;
    options.block_keys = true;  // as `pdsm bake` has them
    const TimedBake timed = timed_bake(scene, light, options, folders.scenes);
    const BakeReport& report = timed.baked.report;
    table.rows.push_back({each.scene, each.light, std::to_string(report.rays), std::to_string(report.events),
                          std::to_string(report.pieces), std::to_string(timed.file_bytes),
                          std::to_string(timed.gpu_bytes)});
    tell(fmt::format("counts: {} {}", each.scene, each.light));
  }
  write_csv(table, folders.results / "counts.csv");
  const std::string worse = list_worse(table, read_csv(PDSM_LIMITS));
  if (!worse.empty()) throw LimitExceeded("worse than tests/bench/limits.csv allows:" + worse);
}

}  // namespace pdsm::bench
