// SPDX-License-Identifier: Apache-2.0
// `pdsm bake` of a whole level: manifest, skipped and failing lights, errors, summary.
#include <cstdio>
#include <fstream>

#include "json_schema.h"
#include "pdsm/format/map_file.h"
#include "scratch_scene.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kUpwards =
    R"({ "name": "up", "type": "rect", "position": [0, 4, 0], "direction": [0, 1, 0], "width": 1, "height": 1 })";
/// Its near lies behind the floor.
constexpr const char* kImpossible =
    R"({ "name": "bad", "type": "disk", "position": [0, 4, 0], "direction": [0, -1, 0], "radius": 1, "near": 99 })";
constexpr const char* kSun = R"({ "name": "sun", "type": "distant", "direction": [1, -2, 0], "angle": 2 })";

class LevelBake : public ScratchScene {
 protected:
  /// two.scene.json with further lights.
  void write_level(const std::string& more_lights) const {
    std::string text = contents("two.scene.json");
    text.insert(text.rfind(" ] }"), ", " + more_lights);
    write_file("level.scene.json", text);
  }
  [[nodiscard]] Outcome bake_level(std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"bake", "level.scene.json", "-o", "maps", "--samples",
                                       "16",   "--resolution",     "32"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments);
  }
  [[nodiscard]] Json manifest() const { return Json::parse(contents("maps/manifest.json")); }
  /// The manifest's entry of a light.
  [[nodiscard]] Json entry(const std::string& name) const {
    const Json whole = manifest();
    for (const Json& light : whole["lights"]) {
      if (light["name"] == name) return light;
    }
    return {};
  }
  static Json schema() {
    std::ifstream file(PDSM_DOCS "/manifest.schema.json");
    return Json::parse(file);
  }
};

TEST_F(LevelBake, ManifestBindsMapsToLights) {
  write_level(kSun);
  ASSERT_EQ(bake_level().exit_code, 0);
  const Json json = manifest();
  EXPECT_EQ(schema_fault(schema(), json), "");
  ASSERT_EQ(json["lights"].size(), 3U);
  const std::string names[]{"key", "lamp", "sun"}, types[]{"rect", "disk", "distant"};
  for (std::size_t n = 0; n < 3; ++n) {
    const Json& light = json["lights"][n];
    EXPECT_EQ(light["name"], names[n]);
    EXPECT_EQ(light["type"], types[n]);
    EXPECT_EQ(light["status"], "baked");
    const std::string file = "maps/" + light["file"].get<std::string>();
    EXPECT_EQ(light["bytes"], fs::file_size(path(file)));
    const PenumbraMap map = read_map(path(file));
    const Json metadata = Json::parse(map.metadata);
    EXPECT_EQ(light["key"], metadata["key"]);
    for (const auto& [key, value] : metadata["light"].items()) EXPECT_EQ(light[key], value) << key;
    const View& view = map.views.at(0);
    EXPECT_EQ(light["view"]["window"], Json(view.window));
    EXPECT_EQ(light["view"]["rotation"], Json(view.world_to_view.rotation));
    EXPECT_EQ(light["view"]["translation"], Json(view.world_to_view.translation));
    EXPECT_EQ(light["view"]["near"], view.near_depth);
    EXPECT_EQ(light["view"]["far"], view.far_depth);
    EXPECT_EQ(light["view"]["resolution"], Json({32, 32}));
  }
}

TEST_F(LevelBake, ManifestIsTheSameForTheSameInputs) {
  write_level(kUpwards);
  ASSERT_EQ(bake_level({"--verify", "--verify-points", "50"}).exit_code, 0);
  const std::string first = contents("maps/manifest.json");
  fs::rename(path("maps"), path("elsewhere"));
  ASSERT_EQ(bake_level({"--verify", "--verify-points", "50", "--threads", "1"}).exit_code, 0);
  EXPECT_EQ(contents("maps/manifest.json"), first);
  EXPECT_EQ(first.find(path("").string()), std::string::npos);
}

TEST_F(LevelBake, OneMapHasNoManifest) {
  bake_small("map.pdsm");
  fs::create_directory(path("maps"));
  ASSERT_EQ(
      run({"bake", "two.scene.json", "--light", "key", "-o", "maps", "--samples", "4", "--resolution", "8"})
          .exit_code,
      0);
  EXPECT_TRUE(exists("maps/key.pdsm"));
  EXPECT_FALSE(exists("manifest.json") || exists("maps/manifest.json"));
}

TEST_F(LevelBake, ALightThatReachesNothingIsSkipped) {
  write_level(kUpwards);
  const Outcome outcome = bake_level({"--report", "report.json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("up: skipped: no receiver"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("maps/up.pdsm"));
  EXPECT_TRUE(exists("maps/key.pdsm"));
  EXPECT_EQ(entry("up")["status"], "skipped");
  EXPECT_NE(entry("up")["reason"].get<std::string>().find("no receiver"), std::string::npos);
  EXPECT_EQ(schema_fault(schema(), manifest()), "");
  const Json report = Json::parse(contents("report.json"));
  EXPECT_EQ(report["up"]["status"], "skipped");
  EXPECT_EQ(report["key"]["status"], "baked");
}

/// A light over receivers that nothing shades: its map is empty, and a map.
TEST_F(LevelBake, ALightThatNothingShadesIsBaked) {
  write_file("bare.scene.json", R"({ "geometry": [ { "file": "floor.obj", "casts": false } ], "lights": [
    { "name": "a", "type": "disk", "position": [0, 4, 0], "direction": [0, -1, 0], "radius": 1 },
    { "name": "b", "type": "disk", "position": [1, 4, 0], "direction": [0, -1, 0], "radius": 1 } ] })");
  ASSERT_EQ(run({"bake", "bare.scene.json", "-o", "maps", "--samples", "4", "--resolution", "8"}).exit_code,
            0);
  EXPECT_EQ(entry("a")["status"], "baked");
  EXPECT_EQ(run({"check", "maps/b.pdsm"}).exit_code, 0);
}

TEST_F(LevelBake, OfASkippedLightNoOldMapStays) {
  write_level(kUpwards);
  fs::create_directory(path("maps"));
  bake_small("maps/up.pdsm");
  const Outcome outcome = bake_level();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_FALSE(exists("maps/up.pdsm"));
  EXPECT_NE(outcome.err.find("the map of before is removed"), std::string::npos) << outcome.err;
  // What is no map was never written by a bake.
  write_file("maps/up.pdsm", "text");
  EXPECT_EQ(bake_level().exit_code, 0);
  EXPECT_EQ(contents("maps/up.pdsm"), "text");
}

TEST_F(LevelBake, AFailingLightLosesNoOther) {
  write_level(kImpossible);
  fs::create_directory(path("maps"));
  write_file("maps/bad.pdsm", "old");
  const Outcome outcome = bake_level({"--quiet", "--report", "report.json"});
  expect_exit(outcome, 3);
  EXPECT_EQ(outcome.err.rfind("bad: bad.near: must be less than far", 0), 0U) << outcome.err;
  EXPECT_TRUE(exists("maps/key.pdsm") && exists("maps/lamp.pdsm"));
  EXPECT_EQ(contents("maps/bad.pdsm"), "old");
  EXPECT_EQ(entry("lamp")["status"], "baked");
  EXPECT_EQ(entry("bad")["status"], "failed");
  EXPECT_EQ(entry("bad")["reason"].get<std::string>().rfind("bad.near: ", 0), 0U);
  EXPECT_FALSE(entry("bad").contains("file"));
  EXPECT_EQ(schema_fault(schema(), manifest()), "");
  EXPECT_EQ(Json::parse(contents("report.json"))["bad"]["status"], "failed");
}

TEST_F(LevelBake, BadOptionsFailOnceAndForAll) {
  write_level(kSun);
  expect_exit(bake_level({"--max-error", "0.1"}), 2);
  expect_exit(bake_level({"--report", "maps/manifest.json"}), 2);
  EXPECT_FALSE(exists("maps/key.pdsm"));
}

TEST_F(LevelBake, SummaryHasALineForEachLight) {
  write_level(std::string(kUpwards) + ", " + kImpossible);
  const Outcome outcome = bake_level({"--verify", "--verify-points", "50"});
  EXPECT_EQ(outcome.exit_code, 3);
  const std::string table = outcome.err.substr(outcome.err.find("\nlight ") + 1);
  for (const char* word : {"status", "seconds", "bytes", "rays", "pieces", "error"})
    EXPECT_NE(table.substr(0, table.find('\n')).find(word), std::string::npos) << word;
  for (const char* line : {"\nkey    baked ", "\nlamp   baked ", "\nup     skipped ", "\nbad    failed ",
                           "\nall    2 baked, 1 skipped, 1 failed "}) {
    EXPECT_NE(table.find(line), std::string::npos) << line << table;
  }
  const std::string bytes = std::to_string(entry("key")["bytes"].get<std::uint64_t>());
  EXPECT_NE(table.find(bytes), std::string::npos) << table;
}

TEST_F(LevelBake, VerifyTellsWhatVerifyTells) {
  write_level(kSun);
  const Outcome outcome = bake_level({"--verify", "--verify-points", "200", "--report", "report.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = Json::parse(contents("report.json"));
  for (const std::string name : {"key", "lamp", "sun"}) {
    const Json alone = Json::parse(run({"verify", "maps/" + name + ".pdsm", "level.scene.json", "--points",
                                        "200", "--no-budget", "--json"})
                                       .out);
    for (const char* key : {"mean_abs_error", "p99_error", "max_error", "points", "shadowed_points"}) {
      EXPECT_EQ(entry(name)["error"][key], alone[key]) << key;
      EXPECT_EQ(report[name]["error"][key], alone[key]) << key;
    }
    char figure[16];
    std::snprintf(figure, sizeof figure, "%.5f", alone["mean_abs_error"].get<double>());
    EXPECT_NE(outcome.err.find(figure), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(schema_fault(schema(), manifest()), "");
}

TEST_F(LevelBake, MaxErrorIsHeld) {
  write_level(kSun);
  const std::vector<std::string> verify{"--verify", "--verify-points", "100", "--quiet", "--max-error"};
  const auto with = [&](const std::string& error) {
    std::vector<std::string> arguments = verify;
    arguments.push_back(error);
    return arguments;
  };
  EXPECT_EQ(bake_level(with("1")).exit_code, 0);
  EXPECT_EQ(bake_level(with("0")).exit_code, 1);
  // What was measured is there to be looked at.
  EXPECT_EQ(entry("sun")["status"], "baked");
  EXPECT_TRUE(entry("sun").contains("error"));
}

TEST(JsonSchema, FindsFaults) {
  const Json schema = Json::parse(R"({ "type": "object", "required": ["a"], "additionalProperties": false,
    "properties": { "a": { "type": "array", "items": { "type": "integer", "minimum": 1 } } } })");
  EXPECT_EQ(schema_fault(schema, Json::parse(R"({"a": [1, 2]})")), "");
  EXPECT_EQ(schema_fault(schema, Json::parse(R"({"a": [1, 0]})")), ".a[1]: minimum");
  EXPECT_EQ(schema_fault(schema, Json::parse(R"({"a": [1.5]})")), ".a[0]: type");
  EXPECT_EQ(schema_fault(schema, Json::parse(R"({"a": [], "b": 1})")), ".b: is not known");
  EXPECT_EQ(schema_fault(schema, Json::parse("{}")), ": required");
}

}  // namespace
}  // namespace pdsm
