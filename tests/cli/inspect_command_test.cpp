// SPDX-License-Identifier: Apache-2.0
// `info` and `check`.
#include <nlohmann/json.hpp>
#include <sstream>

#include "scratch_scene.h"

namespace pdsm {
namespace {

class Inspect : public ScratchScene {
 protected:
  Inspect() { bake_small("map.pdsm"); }
};

TEST_F(Inspect, InfoTellsWhatIsThere) {
  const Outcome outcome = run({"info", "map.pdsm"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word : {"perspective 32 x 32", "window", "depth 16 bits", "samples    16",
                           "texels     1024", "pieces", "modelled", "left out", "name key", "BLCK"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in\n" << outcome.out;
  }
}

/// The sun, straight above a plate of 2 x 2 m one metre over a floor: from the scene file to look-ups.
TEST_F(Inspect, DistantLightEndToEnd) {
  write_file("sun.scene.json", R"({ "geometry": [ { "file": "plate.obj" }, { "file": "floor.obj" } ],
      "lights": [ { "name": "sun", "type": "distant", "direction": [0, -1, 0], "angle": 10 } ] })");
  const Outcome baked =
      run({"bake", "sun.scene.json", "-o", "sun.pdsm", "--samples", "64", "--resolution", "64"});
  ASSERT_EQ(baked.exit_code, 0) << baked.err;
  EXPECT_EQ(run({"check", "sun.pdsm"}).exit_code, 0);
  const Outcome told = run({"info", "sun.pdsm"});
  for (const char* word : {"orthographic 64 x 64", "type distant", "angle 10", "the light is distant",
                           "the light's rays are parallel"}) {
    EXPECT_NE(told.out.find(word), std::string::npos) << word << " in\n" << told.out;
  }
  // In the umbra, 1 m - tan 5 degrees wide; at its plate's edge; lit; above the plate.
  RunSetup points;
  points.input = "0 0.01 0\n1 0.01 0.3\n1.2 0.01 0\n0 1.5 0\n";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"query", "sun.pdsm"}, std::vector<std::string>{"truth", "sun.scene.json"}}) {
    const Outcome answers = run(command, points);
    ASSERT_EQ(answers.exit_code, 0) << answers.err;
    std::istringstream lines(answers.out);
    double umbra = 0, edge = 0, lit = 1, above = 1;
    lines >> umbra >> edge >> lit >> above;
    EXPECT_NEAR(umbra, 1, 0.02);
    // Half, but for what 64 samples, a texel of 0.034 m over a penumbra of 0.175 m, and epsilon are off.
    EXPECT_NEAR(edge, 0.5, 0.163 + 0.034 / 0.175 + 0.02);
    EXPECT_EQ(lit, 0);
    EXPECT_EQ(above, 0);
  }
  EXPECT_EQ(run({"verify", "sun.pdsm", "sun.scene.json", "--points", "200", "--samples", "64"}).exit_code, 0);
}

TEST_F(Inspect, InfoJsonAddsUp) {
  const Outcome outcome = run({"info", "map.pdsm", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto info = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(info["views"][0]["width"], 32);
  EXPECT_EQ(info["samples"], 16);
  EXPECT_EQ(info["functions"]["texels"], 1024);
  EXPECT_GT(info["functions"]["empty_texels"], 0);
  EXPECT_LT(info["functions"]["empty_texels"], 1024);
  EXPECT_EQ(info["metadata"]["light"]["name"], "key");
  EXPECT_EQ(info["bytes"]["file"], contents("map.pdsm").size());
  std::uint64_t stored = 0;
  for (const auto& part : info["bytes"]["parts"]) stored += part["stored"].get<std::uint64_t>();
  EXPECT_LT(stored, info["bytes"]["file"]);  // header and table are no chunks
  EXPECT_GT(stored, 0U);
}

TEST_F(Inspect, InfoTellsLevelsApart) {
  EXPECT_EQ(run({"info", "map.pdsm"}).out.find("level 0"), std::string::npos) << "one level says nothing";
  bake_small("mips.pdsm", {"--mip-levels", "2"});
  EXPECT_EQ(run({"check", "mips.pdsm"}).exit_code, 0);
  const Outcome text = run({"info", "mips.pdsm"});
  for (const char* word : {"level 0", "level 2", "1024 texels", "256 texels", "64 texels"}) {
    EXPECT_NE(text.out.find(word), std::string::npos) << word << " in\n" << text.out;
  }
  const auto info = nlohmann::json::parse(run({"info", "mips.pdsm", "--json"}).out);
  ASSERT_EQ(info["levels"].size(), 3U);
  std::uint64_t texels = 0, pieces = 0, stored = 0, decoded = 0;
  for (const auto& level : info["levels"]) {
    texels += level["texels"].get<std::uint64_t>();
    pieces += level["pieces"].get<std::uint64_t>();
    stored += level["stored"].get<std::uint64_t>();
    decoded += level["decoded"].get<std::uint64_t>();
    EXPECT_GT(level["pieces"], 0);
    EXPECT_GT(level["stored"], 0);
    EXPECT_GT(level["decoded"], 0);
  }
  EXPECT_EQ(texels, 1024U + 256 + 64);
  EXPECT_EQ(texels, info["functions"]["texels"]);
  EXPECT_EQ(pieces, info["functions"]["pieces"]);
  EXPECT_EQ(stored, info["bytes"]["parts"]["BLCK"]["stored"]);
  EXPECT_EQ(decoded, info["bytes"]["parts"]["BLCK"]["decoded"]);
}

TEST_F(Inspect, CheckSaysOk) {
  const Outcome outcome = run({"check", "map.pdsm"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "ok\n");
}

TEST_F(Inspect, CheckNamesTheFirstFault) {
  const std::string good = contents("map.pdsm");
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 4);
  for (const std::string& bad :
       {std::string(), good.substr(0, 100), good + 'x', flipped, std::string("hello")}) {
    write_file("bad.pdsm", bad);
    const Outcome outcome = run({"check", "bad.pdsm"});
    expect_exit(outcome, 3);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("bad.pdsm:offset ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(": fault "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(": expected "), std::string::npos) << outcome.err;
    expect_exit(run({"info", "bad.pdsm"}), 3);
  }
}

TEST_F(Inspect, NoFileIsBadInput) {
  for (const std::string command : {"info", "check"}) {
    for (const std::string name : {"missing", ".", "/dev/null", ""}) {
      expect_exit(run({command, name}), 3);
    }
  }
}

}  // namespace
}  // namespace pdsm
