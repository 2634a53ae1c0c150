// SPDX-License-Identifier: Apache-2.0
// Measures what the papers' tables and curves measure and writes ours beside theirs. tests/bench/results
// prepares its scenes and runs it.
// usage: bench_results PDSM SCENES RESULTS STEP...
// steps: sizes times memory threads growth counts soft-shadows tables
#include <fmt/core.h>

#include <exception>
#include <map>
#include <stdexcept>
#include <string>

#include "pdsm/format/error.h"
#include "steps.h"

namespace pdsm::bench {
namespace {

void write_tables(const Folders& folders) {
  replace_tables(folders.results / "README.md", make_tables(folders) + make_front_tables(folders));
}

void run(const Folders& folders, const std::string& step) {
  static const std::map<std::string, void (*)(const Folders&)> kSteps{{"sizes", measure_sizes},
                                                                      {"times", measure_times},
                                                                      {"memory", measure_memory},
                                                                      {"threads", measure_threads},
                                                                      {"growth", measure_growth},
                                                                      {"counts", measure_counts},
                                                                      {"soft-shadows", measure_soft_shadows},
                                                                      {"tables", write_tables}};
  const auto found = kSteps.find(step);
  if (found == kSteps.end()) throw Error(Failure::usage, step, "no such step");
  found->second(folders);
}

}  // namespace

void tell(const std::string& line) {
  fmt::print(stderr, "{}\n", line);
}

const Light& only_light(const Scene& scene) {
  if (scene.lights.size() != 1) throw Error(Failure::input, scene.source, "must have one light");
  return scene.lights.front();
}

}  // namespace pdsm::bench

int main(int argc, char** argv) {
  if (argc < 5) {
    fmt::print(stderr, "usage: bench_results PDSM SCENES RESULTS STEP...\n");
    return 2;
  }
  try {
    for (int n = 4; n < argc; ++n) pdsm::bench::run({argv[2], argv[3], argv[1]}, argv[n]);
  } catch (const pdsm::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.failure());
  } catch (const pdsm::bench::LimitExceeded& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 4;
  }
  return 0;
}
