// SPDX-License-Identifier: Apache-2.0
#include <signal.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "pdsm/format/map_file.h"
#include "scratch_scene.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kQuick{"--samples", "16", "--resolution", "32"};

class BakeCommand : public ScratchScene {
 protected:
  /// `bake` with quick options behind the arguments.
  [[nodiscard]] Outcome bake(std::vector<std::string> arguments, const RunSetup& setup = {}) const {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), kQuick.begin(), kQuick.end());
    return run(arguments, setup);
  }
};

TEST_F(BakeCommand, WritesOneMapAndNothingElse) {
  const std::vector<std::string> before = listing();
  const Outcome outcome = bake({"one.scene.json", "-o", "map.pdsm"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(listing().size(), before.size() + 1);
  const PenumbraMap map = read_map(path("map.pdsm"));
  EXPECT_EQ(map.samples.size(), 16U);
  EXPECT_EQ(map.views.at(0).width, 32U);
}

TEST_F(BakeCommand, QuietSaysNothing) {
  const Outcome outcome = bake({"one.scene.json", "-o", "map.pdsm", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(BakeCommand, NeedsAnOutputUnlessDry) {
  const Outcome outcome = bake({"one.scene.json"});
  expect_exit(outcome, 2);
  EXPECT_EQ(outcome.err.rfind("--output: ", 0), 0U) << outcome.err;
  const std::vector<std::string> before = listing();
  const Outcome dry = bake({"one.scene.json", "--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_EQ(listing(), before);
  for (const char* word : {"rays", "time", "memory", "tiles", "window", "near, far", "receivers outside"}) {
    EXPECT_NE(dry.out.find(word), std::string::npos) << word;
  }
}

TEST_F(BakeCommand, SeveralLightsMakeAFolder) {
  const Outcome outcome = bake({"two.scene.json", "-o", "maps", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(exists("maps/key.pdsm"));
  EXPECT_TRUE(exists("maps/lamp.pdsm"));
  // A folder that is there will do too, also for one light.
  EXPECT_EQ(bake({"two.scene.json", "-o", "maps", "--quiet"}).exit_code, 0);
  EXPECT_EQ(bake({"one.scene.json", "-o", "maps", "--quiet"}).exit_code, 0);
  // A file will not.
  write_file("taken", "text");
  expect_exit(bake({"two.scene.json", "-o", "taken"}), 2);
  EXPECT_EQ(contents("taken"), "text");
}

TEST_F(BakeCommand, LightChoosesOne) {
  EXPECT_EQ(bake({"two.scene.json", "--light", "lamp", "-o", "lamp.pdsm", "--quiet"}).exit_code, 0);
  const auto metadata = nlohmann::json::parse(read_map(path("lamp.pdsm")).metadata);
  EXPECT_EQ(metadata["light"]["name"], "lamp");
  EXPECT_EQ(metadata["light"]["type"], "disk");
  const Outcome unknown = bake({"two.scene.json", "--light", "sun", "-o", "sun.pdsm"});
  expect_exit(unknown, 2);
  EXPECT_EQ(unknown.err.rfind("--light: ", 0), 0U) << unknown.err;
}

TEST_F(BakeCommand, LightsOwnOptionsAreDefaults) {
  std::string scene = contents("one.scene.json");
  scene.replace(scene.find("\"name\": \"key\""), 13,
                R"("name": "key", "samples": 9, "resolution": [24, 16])");
  write_file("own.scene.json", scene);
  ASSERT_EQ(run({"bake", "own.scene.json", "-o", "own.pdsm", "--quiet"}).exit_code, 0);
  const PenumbraMap own = read_map(path("own.pdsm"));
  EXPECT_EQ(own.samples.size(), 9U);
  EXPECT_EQ(own.views.at(0).width, 24U);
  EXPECT_EQ(own.views.at(0).height, 16U);
  ASSERT_EQ(bake({"own.scene.json", "-o", "own.pdsm", "--quiet"}).exit_code, 0);
  const PenumbraMap overridden = read_map(path("own.pdsm"));
  EXPECT_EQ(overridden.samples.size(), 16U);
  EXPECT_EQ(overridden.views.at(0).width, 32U);
}

TEST_F(BakeCommand, MetadataTellsWhatWasBaked) {
  bake_small("map.pdsm", {"--epsilon", "0.05", "--seed", "7"});
  const auto metadata = nlohmann::json::parse(read_map(path("map.pdsm")).metadata);
  EXPECT_EQ(metadata["tool"]["name"], "pdsm");
  EXPECT_EQ(metadata["light"]["name"], "key");
  EXPECT_EQ(metadata["light"]["width"], 1.0);
  EXPECT_EQ(metadata["light"]["position"], (std::vector<double>{0, 4, 0}));
  EXPECT_EQ(metadata["light"]["direction"], (std::vector<double>{0, -1, 0}));
  EXPECT_EQ(metadata["epsilon"], 0.05);
  EXPECT_EQ(metadata["options"]["seed"], 7);
  EXPECT_EQ(metadata["key"].get<std::string>().size(), 32U);
  EXPECT_FALSE(metadata["isa"].get<std::string>().empty());
  EXPECT_FALSE(metadata["modelled"].empty());
}

TEST_F(BakeCommand, ReportHasItsKeys) {
  bake_small("map.pdsm", {"--report", "report.json"});
  const auto report = nlohmann::json::parse(contents("report.json"));
  for (const char* key : {"seconds", "rays", "events", "texels", "pieces", "bytes", "samples", "resolution",
                          "epsilon", "depth_tolerance", "bias", "walk", "isa", "modelled"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  for (const char* key : {"load", "bvh", "trace", "walk", "accumulate", "fit", "write", "total"}) {
    EXPECT_TRUE(report["seconds"].contains(key)) << key;
  }
  EXPECT_GT(report["bytes"]["peak_memory"], 0);
  // In textures, a function takes a word of the index and its vertices.
  std::uint64_t words = 32 * 32;
  const PenumbraMap map = read_map(path("map.pdsm"));
  for (const FunctionBlock& block : map.images.at(0).blocks) words += block.words.size();
  EXPECT_EQ(report["bytes"]["gpu"], 4 * words);
  EXPECT_EQ(report["bytes"]["file"], fs::file_size(path("map.pdsm")));
  EXPECT_EQ(report["texels"], 32 * 32);
  EXPECT_EQ(report["samples"], 16);
}

TEST_F(BakeCommand, MipLevelsAreMadeAndRecorded) {
  const auto is_modelled = [](const nlohmann::json& record) {
    for (const auto& feature : record["modelled"]) {
      if (feature["feature"] == "mip levels") return feature["modelled"].get<bool>();
    }
    throw std::runtime_error("mip levels are not mentioned");
  };
  for (const auto& [asked, made] : {std::pair("0", 0U), std::pair("3", 3U), std::pair("6", 5U)}) {
    bake_small("map.pdsm", {"--mip-levels", asked, "--report", "report.json"});
    const PenumbraMap map = read_map(path("map.pdsm"));
    EXPECT_EQ(map.images.size(), made + 1);
    for (const auto& record :
         {nlohmann::json::parse(contents("report.json")), nlohmann::json::parse(map.metadata)}) {
      EXPECT_EQ(is_modelled(record), made > 0);
    }
    EXPECT_EQ(nlohmann::json::parse(contents("report.json"))["mip_levels"], made);
    EXPECT_EQ(nlohmann::json::parse(map.metadata)["options"]["mip_levels"], made);
  }
}

TEST_F(BakeCommand, ReportOfSeveralLightsNamesThem) {
  ASSERT_EQ(bake({"two.scene.json", "-o", "maps", "--quiet", "--report", "report.json"}).exit_code, 0);
  const auto report = nlohmann::json::parse(contents("report.json"));
  EXPECT_EQ(report["key"]["samples"], 16);
  EXPECT_EQ(report["lamp"]["samples"], 16);
}

TEST_F(BakeCommand, SameInputSameBytes) {
  for (const std::string levels : {"0", "6"}) {
    bake_small("a.pdsm", {"--mip-levels", levels, "--threads", "1"});
    bake_small("b.pdsm", {"--mip-levels", levels, "--threads", "3", "--tile", "64", "--report", "r.json"});
    EXPECT_TRUE(contents("a.pdsm") == contents("b.pdsm"));
  }
}

TEST_F(BakeCommand, AThousandThreadsAreFine) {
  bake_small("a.pdsm");
  bake_small("b.pdsm", {"--threads", "1000", "--memory", "64G"});  // a plan sets aside 12M a thread
  EXPECT_TRUE(contents("a.pdsm") == contents("b.pdsm"));
}

TEST_F(BakeCommand, NeverOverwritesItsInput) {
  fs::create_hard_link(path("floor.obj"), path("hard.pdsm"));
  fs::create_symlink("plate.obj", path("soft.pdsm"));
  for (const std::string output :
       {"one.scene.json", "./one.scene.json", "plate.obj", "hard.pdsm", "soft.pdsm"}) {
    const std::string before = contents(output);
    expect_exit(bake({"one.scene.json", "-o", output}), 2);
    expect_exit(bake({"one.scene.json", "-o", "x.pdsm", "--report", output}), 2);
    EXPECT_EQ(contents(output), before) << output;
  }
  expect_exit(bake({"one.scene.json", "-o", "x.pdsm", "--report", "./x.pdsm"}), 2);
  EXPECT_FALSE(exists("x.pdsm"));
}

TEST_F(BakeCommand, BadFoldersFailBeforeBaking) {
  // With so many samples, a bake would not end in time.
  const std::vector<std::string> slow{"--samples", "65536", "--resolution", "2048"};
  for (const std::string output : {"missing/map.pdsm", "plate.obj/map.pdsm"}) {
    std::vector<std::string> arguments{"bake", "one.scene.json", "-o", output};
    arguments.insert(arguments.end(), slow.begin(), slow.end());
    expect_exit(run(arguments), 4);
    arguments[3] = "map.pdsm";
    arguments.insert(arguments.end(), {"--report", output});
    expect_exit(run(arguments), 4);
  }
  EXPECT_FALSE(exists("map.pdsm"));
}

TEST_F(BakeCommand, ReadOnlyFolderFailsBeforeBaking) {
  fs::create_directory(path("locked"));
  fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                      fs::perms::others_exec);
  RunSetup setup;
  setup.unprivileged = true;
  const Outcome outcome =
      run({"bake", "one.scene.json", "-o", "locked/map.pdsm", "--samples", "65536", "--resolution", "2048"},
          setup);
  fs::permissions(path("locked"), fs::perms::all);
  if (outcome.exit_code == kNotRun) GTEST_SKIP() << "the binary is out of reach without root's rights";
  expect_exit(outcome, 4);
  EXPECT_NE(outcome.err.find("locked/map.pdsm"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("locked/map.pdsm"));
}

TEST_F(BakeCommand, BadScenesAreBadInput) {
  write_file("broken.scene.json", "{ \"geometry\": [\n");
  write_file("unlit.scene.json", R"({ "geometry": [ { "file": "plate.obj" } ], "lights": [] })");
  for (const std::string scene :
       {"missing.json", "broken.scene.json", "unlit.scene.json", "plate.obj", "."}) {
    const Outcome outcome = bake({scene, "-o", "x.pdsm"});
    expect_exit(outcome, 3);
    EXPECT_EQ(outcome.err.rfind(scene, 0), 0U) << outcome.err;
  }
  EXPECT_FALSE(exists("x.pdsm"));
}

TEST_F(BakeCommand, FailureKeepsTheOldFile) {
  write_file("map.pdsm", "old");
  expect_exit(bake({"missing.json", "-o", "map.pdsm"}), 3);
  expect_exit(bake({"one.scene.json", "-o", "map.pdsm", "--memory", "1"}), 4);
  EXPECT_EQ(contents("map.pdsm"), "old");
}

TEST_F(BakeCommand, StrangePathsWork) {
  fs::create_directory(path("mit Leerzeichen"));
  for (const std::string name : {"with space.pdsm", "schön-影.pdsm", "mit Leerzeichen/a b.pdsm"}) {
    SCOPED_TRACE(name);
    expect_exit(bake({"one.scene.json", "--quiet", "-o", name}), 0);
    expect_exit(run({"check", name}), 0);
  }
  EXPECT_EQ(bake({"one.scene.json", "--quiet", "-o", "-dash.pdsm"}).exit_code, 0);
  EXPECT_EQ(run({"check", "--", "-dash.pdsm"}).exit_code, 0);
  EXPECT_EQ(run({"check", "./-dash.pdsm"}).exit_code, 0);
  fs::copy_file(path("one.scene.json"), path("-a b.scene.json"));
  EXPECT_EQ(
      run({"bake", "-o", "x.pdsm", "--samples", "4", "--resolution", "8", "--", "-a b.scene.json"}).exit_code,
      0);
}

TEST_F(BakeCommand, InterruptLeavesNothingBehind) {
  for (const int signal : {SIGINT, SIGTERM}) {
    write_file("map.pdsm", "old");
    const std::vector<std::string> before = listing();
    // Far more than can be baked in the time of a test.
    RunningPdsm baking(
        {"bake", "one.scene.json", "-o", "map.pdsm", "--samples", "65536", "--resolution", "2048"}, path(""));
    ASSERT_TRUE(baking.wait_for_handler(signal));
    ASSERT_TRUE(baking.wait_for_cpu_seconds(0.5));
    baking.send(signal);
    EXPECT_EQ(baking.wait(), 130);
    EXPECT_EQ(listing(), before);
    EXPECT_EQ(contents("map.pdsm"), "old");
  }
}

TEST_F(BakeCommand, ResultsThatCanNotBeToldFail) {
  RunSetup setup;
  setup.out = Stdout::full;
  expect_exit(bake({"one.scene.json", "--dry-run"}, setup), 4);
  // A bake has no results on stdout, and does not mind.
  setup.out = Stdout::closed;
  EXPECT_EQ(bake({"one.scene.json", "-o", "map.pdsm", "--quiet"}, setup).exit_code, 0);
  EXPECT_EQ(run({"check", "map.pdsm"}).exit_code, 0);
}

TEST_F(BakeCommand, DeepNestingIsBadInput) {
  // Deep enough to overflow a stack, were it followed.
  write_file("deep.scene.json", std::string(200'000, '['));
  expect_exit(run({"bake", "deep.scene.json", "-o", "x.pdsm"}), 3);
  expect_exit(run({"render", "deep.scene.json", "-o", "x.png", "--truth"}), 3);
}

TEST_F(BakeCommand, EndlessWalksAreRefused) {
  std::string scene = contents("one.scene.json");
  const std::string direction = "\"direction\"";
  scene.replace(scene.find(direction), direction.size(), "\"near\": 1e-9, " + direction);
  write_file("near.scene.json", scene);
  const Outcome outcome = run({"bake", "near.scene.json", "-o", "x.pdsm"});
  expect_exit(outcome, 4);
  EXPECT_NE(outcome.err.find("1e-09"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pdsm
