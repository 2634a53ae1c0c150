// SPDX-License-Identifier: Apache-2.0
// A bake's counts against tests/bench/limits.csv, for the scene of it that is in the project.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scratch_scene.h"

namespace pdsm {
namespace {

/// The row of a scene and light, by column.
std::map<std::string, double> read_limits(const std::string& scene, const std::string& light) {
  std::ifstream file(PDSM_LIMITS);
  std::string header, line;
  std::getline(file, header);
  while (std::getline(file, line)) {
    if (line.rfind(scene + "," + light + ",", 0) != 0) continue;
    std::map<std::string, double> limits;
    std::istringstream names(header), cells(line);
    for (std::string name, cell; std::getline(names, name, ',') && std::getline(cells, cell, ',');)
      if (name != "scene" && name != "light") limits[name] = std::stod(cell);
    return limits;
  }
  return {};
}

class CountLimits : public ScratchScene {};

TEST_F(CountLimits, OfThePlateHold) {
  const Outcome outcome = run({"bake", PDSM_EXAMPLES "/plate.scene.json", "-o", "map.pdsm", "--samples",
                               "256", "--resolution", "512", "--report", "report.json", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json report = nlohmann::json::parse(std::ifstream(path("report.json")));
  const std::map<std::string, double> limits = read_limits("plate", "key");
  ASSERT_EQ(limits.size(), 5U);
  for (const char* count : {"rays", "events", "pieces"})
    EXPECT_LE(report.at(count).get<double>(), limits.at(count)) << count;
  EXPECT_LE(report.at("bytes").at("file").get<double>(), limits.at("file_bytes"));
  EXPECT_LE(report.at("bytes").at("gpu").get<double>(), limits.at("gpu_bytes"));
}

}  // namespace
}  // namespace pdsm
