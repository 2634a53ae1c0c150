// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "csv_table.h"
#include "steps.h"
#include "thesis.h"

extern char** environ;

namespace pdsm::bench {
namespace {

/// Runs a program to its end.
void run(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t pid = -1;
  int status = 0;
  if (posix_spawn(&pid, argv.front(), nullptr, nullptr, argv.data(), environ) != 0 ||
      waitpid(pid, &status, 0) != pid || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(words.front() + ": failed");
  }
}

}  // namespace

void measure_memory(const Folders& folders) {
  // The most memory that a process had is known of a process: each bake is one.
  CsvTable table{{"samples", "tile", "peak_bytes", "scene_bytes", "rays", "seconds"}, {}};
  const std::filesystem::path report = folders.scenes / "memory.json", map = folders.scenes / "memory.pdsm";
  for (const std::uint32_t samples : thesis::kSamples) {
    for (const std::uint32_t tile : {256U, 128U}) {
      run({folders.pdsm.string(), "bake", (folders.scenes / "dragon.scene.json").string(), "-o", map.string(),
           "--samples", std::to_string(samples), "--resolution", "256", "--tile", std::to_string(tile),
           "--report", report.string(), "--quiet"});
      std::ifstream file(report);
      const nlohmann::json json = nlohmann::json::parse(file);
      const auto& bytes = json.at("bytes");
      const double seconds =
          json.at("seconds").at("total").get<double>() - json.at("seconds").at("load").get<double>();
      table.rows.push_back({std::to_string(samples), std::to_string(tile),
                            std::to_string(bytes.at("peak_memory").get<std::uint64_t>()),
                            std::to_string(bytes.at("resident_after_bvh").get<std::uint64_t>()),
                            std::to_string(json.at("rays").get<std::uint64_t>()),
                            fmt::format("{:.3f}", seconds)});
    }
    tell(fmt::format("memory: {} samples", samples));
  }
  std::filesystem::remove(map);
  std::filesystem::remove(report);
  write_csv(table, folders.results / "memory.csv");
}

}  // namespace pdsm::bench
