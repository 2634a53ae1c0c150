// SPDX-License-Identifier: Apache-2.0
// What is up to date is not baked again, and what is baked again is what a bake of all would have made.
#include <sys/stat.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "pdsm/format/map_file.h"
#include "scratch_scene.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Tells apart whether a file was written anew: AtomicFile puts another one in its place.
class KeptFile {
 public:
  explicit KeptFile(const fs::path& path) : path_(path), open_(path), before_(status()) {}

  [[nodiscard]] bool is_untouched() const {
    const struct stat now = status();
    return now.st_ino == before_.st_ino && now.st_mtim.tv_sec == before_.st_mtim.tv_sec &&
           now.st_mtim.tv_nsec == before_.st_mtim.tv_nsec;
  }

 private:
  [[nodiscard]] struct stat status() const {
    struct stat result {};
    if (stat(path_.c_str(), &result) != 0) throw std::runtime_error(path_.string());
    return result;
  }

  fs::path path_;
  std::ifstream open_;  // so that no other file can take its number
  struct stat before_;
};

class IncrementalBake : public ScratchScene {
 protected:
  /// A crate beside the plate, seen by one of two lights that stand far apart; `crate`: its place along x.
  void write_level(double crate) const {
    write_file("level.scene.json", R"({ "geometry": [ { "file": "plate.obj" }, { "file": "floor.obj" },
      { "file": "plate.obj", "scale": 0.3, "translate": [)" +
                                       std::to_string(crate) + R"(, 0.5, 0] } ], "lights": [
      { "name": "left", "type": "rect", "position": [-4, 4, 0], "direction": [0, -1, 0], "width": 1, "height": 1, "fov": 40 },
      { "name": "right", "type": "disk", "position": [5, 4, 0], "direction": [0, -1, 0], "radius": 0.5, "fov": 40 } ] })");
  }
  [[nodiscard]] Outcome bake_level(const std::string& folder, std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"bake", "level.scene.json", "-o", folder, "--samples",
                                       "16",   "--resolution",     "48"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments);
  }
  [[nodiscard]] std::map<std::string, std::string> files_in(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(path(folder)))
      files[entry.path().filename().string()] = contents(folder + "/" + entry.path().filename().string());
    return files;
  }
  [[nodiscard]] Json status_of(const std::string& light) const {
    return Json::parse(contents("report.json"))[light]["status"];
  }
};

TEST_F(IncrementalBake, NothingIsTouchedWhenNothingChanged) {
  write_level(5);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  const KeptFile left(path("maps/left.pdsm")), right(path("maps/right.pdsm")),
      manifest(path("maps/manifest.json"));
  const Outcome again = bake_level("maps", {"--report", "report.json", "--threads", "1", "--memory", "1G"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("left: unchanged\n"), std::string::npos) << again.err;
  EXPECT_NE(again.err.find("2 unchanged "), std::string::npos) << again.err;
  EXPECT_EQ(status_of("left"), "unchanged");
  EXPECT_TRUE(left.is_untouched() && right.is_untouched() && manifest.is_untouched());
  // No ray is traced, and the report tells of none.
  EXPECT_FALSE(Json::parse(contents("report.json"))["left"].contains("rays"));
}

TEST_F(IncrementalBake, OnlyTheLightsThatSeeAChangeAreBaked) {
  write_level(5);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  const KeptFile left(path("maps/left.pdsm")), right(path("maps/right.pdsm"));
  write_level(5.2);
  ASSERT_EQ(bake_level("maps", {"--report", "report.json"}).exit_code, 0);
  EXPECT_EQ(status_of("left"), "unchanged");
  EXPECT_EQ(status_of("right"), "baked");
  EXPECT_TRUE(left.is_untouched());
  EXPECT_FALSE(right.is_untouched());
  ASSERT_EQ(bake_level("fresh").exit_code, 0);
  EXPECT_EQ(files_in("maps"), files_in("fresh"));
  // To where neither light sees it.
  write_level(0.5);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  const KeptFile none(path("maps/right.pdsm"));
  write_level(0.7);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  EXPECT_TRUE(left.is_untouched() && none.is_untouched());
  ASSERT_EQ(bake_level("fresh2").exit_code, 0);
  EXPECT_EQ(files_in("maps"), files_in("fresh2"));
}

TEST_F(IncrementalBake, OtherOptionsAreBakedAnew) {
  write_level(5);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  const KeptFile left(path("maps/left.pdsm"));
  ASSERT_EQ(bake_level("maps", {"--epsilon", "0.1"}).exit_code, 0);
  EXPECT_FALSE(left.is_untouched());
  ASSERT_EQ(bake_level("fresh", {"--epsilon", "0.1"}).exit_code, 0);
  EXPECT_EQ(files_in("maps"), files_in("fresh"));
}

/// Two small tiles over the floor under a light whose map has 2 x 2 blocks; one moves within the first
/// quarter.
class BlocksOfAMap : public IncrementalBake {
 protected:
  void write_tiles(const char* x) const {
    write_file("tile.obj", "v -0.1 0 -0.1\nv -0.1 0 0.1\nv 0.1 0 0.1\nv 0.1 0 -0.1\nf 1 2 3\nf 1 3 4\n");
    write_file("tiles.scene.json", std::string(R"({ "geometry": [ { "file": "floor.obj" },
      { "file": "tile.obj", "translate": [0.6, 2, 0.6] }, { "file": "tile.obj", "translate": [)") +
                                       x + R"(, 2, -0.6] } ], "lights": [
      { "name": "key", "type": "rect", "position": [0, 4, 0], "direction": [0, -1, 0], "width": 0.5, "height": 0.5, "fov": 40 } ] })");
  }
  /// Returns how many blocks were taken over.
  [[nodiscard]] int bake_tiles(const std::string& output, std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"bake", "tiles.scene.json", "-o",  output,     "--samples",
                                       "16",   "--resolution",     "128", "--report", "report.json"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    Json report = Json::parse(contents("report.json"));
    if (report.contains("key") && report["key"].is_object()) report = report["key"];
    EXPECT_EQ(report["blocks"], 4);
    return report["blocks_taken_over"].get<int>();
  }
};

TEST_F(BlocksOfAMap, OnlyThoseThatAChangeTouchesAreBaked) {
  write_tiles("-0.6");
  EXPECT_EQ(bake_tiles("map.pdsm"), 0);
  const std::string before = contents("map.pdsm");
  write_tiles("-0.62");
  EXPECT_EQ(bake_tiles("map.pdsm"), 3);
  EXPECT_EQ(bake_tiles("fresh.pdsm"), 0);
  EXPECT_EQ(contents("map.pdsm"), contents("fresh.pdsm"));
  EXPECT_EQ(run({"check", "map.pdsm"}).out, "ok\n");
  EXPECT_NE(run({"info", "map.pdsm"}).out.find("  BKEY     160 "), std::string::npos);
  // All of it where that is asked for, or all blocks of before are damaged.
  write_file("map.pdsm", before);
  EXPECT_EQ(bake_tiles("map.pdsm", {"--force"}), 0);
  EXPECT_EQ(contents("map.pdsm"), contents("fresh.pdsm"));
  write_file("map.pdsm", before.substr(0, before.size() - 1));
  EXPECT_EQ(bake_tiles("map.pdsm"), 0);
  EXPECT_EQ(contents("map.pdsm"), contents("fresh.pdsm"));
}

TEST_F(BlocksOfAMap, AreToldOfInTheSummaryAndNotInTheManifest) {
  fs::create_directory(path("maps"));
  fs::create_directory(path("fresh"));
  write_tiles("-0.6");
  EXPECT_EQ(bake_tiles("maps"), 0);
  write_tiles("-0.62");
  const Outcome outcome =
      run({"bake", "tiles.scene.json", "-o", "maps", "--samples", "16", "--resolution", "128"});
  EXPECT_NE(outcome.err.find(" 3/4 "), std::string::npos) << outcome.err;
  EXPECT_EQ(bake_tiles("fresh"), 0);
  EXPECT_EQ(files_in("maps"), files_in("fresh"));
}

TEST_F(BlocksOfAMap, SurviveExchange) {
  write_tiles("-0.6");
  EXPECT_EQ(bake_tiles("map.pdsm"), 0);
  EXPECT_EQ(run({"export", "map.pdsm", "-o", "deep.exr"}).exit_code, 0);
  EXPECT_EQ(run({"import", "deep.exr", "-o", "again.pdsm"}).exit_code, 0);
  write_tiles("-0.62");
  EXPECT_EQ(bake_tiles("again.pdsm"), 3);
  EXPECT_EQ(bake_tiles("fresh.pdsm"), 0);
  EXPECT_EQ(contents("again.pdsm"), contents("fresh.pdsm"));
}

TEST_F(IncrementalBake, ForceBakesAnyway) {
  write_level(5);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  const auto before = files_in("maps");
  const KeptFile left(path("maps/left.pdsm"));
  ASSERT_EQ(bake_level("maps", {"--force", "--report", "report.json"}).exit_code, 0);
  EXPECT_FALSE(left.is_untouched());
  EXPECT_EQ(status_of("left"), "baked");
  EXPECT_EQ(files_in("maps"), before);
}

/// One byte of the last block: header, table and metadata are whole.
TEST_F(IncrementalBake, DamagedMapsAreBakedAnew) {
  write_level(5);
  ASSERT_EQ(bake_level("maps").exit_code, 0);
  const auto before = files_in("maps");
  std::string bytes = before.at("left.pdsm");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_file("maps/left.pdsm", bytes);
  write_file("maps/right.pdsm", before.at("right.pdsm").substr(0, 100));
  EXPECT_EQ(bake_level("maps").exit_code, 0);
  EXPECT_EQ(files_in("maps"), before);
}

TEST_F(IncrementalBake, HoldsForOneMapToo) {
  bake_small("map.pdsm");
  const KeptFile map(path("map.pdsm"));
  const std::vector<std::string> again{"bake", "one.scene.json", "-o", "map.pdsm", "--samples",
                                       "16",   "--resolution",   "32"};
  const Outcome outcome = run(again);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.rfind("key: unchanged\n", 0), 0U) << outcome.err;
  EXPECT_TRUE(map.is_untouched());
  // Of another light by the same name, and of the same light by another name.
  write_file("lamp.scene.json", contents("two.scene.json"));
  ASSERT_EQ(run({"bake", "lamp.scene.json", "--light", "lamp", "-o", "map.pdsm", "--samples", "16",
                 "--resolution", "32"})
                .exit_code,
            0);
  EXPECT_FALSE(map.is_untouched());
  EXPECT_EQ(Json::parse(read_map(path("map.pdsm")).metadata)["light"]["name"], "lamp");
}

TEST_F(IncrementalBake, GoalsAreRemembered) {
  const std::vector<std::string> goal{"--target-error", "0.2", "--samples", "16", "--map-resolution", "32"};
  const auto bake = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"bake", "one.scene.json", "-o", "map.pdsm", "--quiet"});
    return run(arguments).exit_code;
  };
  ASSERT_EQ(bake(goal), 0);
  const KeptFile first(path("map.pdsm"));
  ASSERT_EQ(bake(goal), 0);
  EXPECT_TRUE(first.is_untouched());
  // The same settings without a goal are another map: it does not tell what was achieved.
  const Json options = Json::parse(read_map(path("map.pdsm")).metadata)["options"];
  const auto size = [](const Json& wh) { return wh[0].dump() + "x" + wh[1].dump(); };
  const std::vector<std::string> settings{"--samples",        "16",
                                          "--resolution",     size(options["resolution"]),
                                          "--map-resolution", size(options["map_resolution"]),
                                          "--epsilon",        options["epsilon"].dump()};
  ASSERT_EQ(bake(settings), 0);
  EXPECT_FALSE(first.is_untouched());
  EXPECT_FALSE(Json::parse(read_map(path("map.pdsm")).metadata).contains("achieved"));
  const KeptFile plain(path("map.pdsm"));
  ASSERT_EQ(bake(goal), 0);
  EXPECT_FALSE(plain.is_untouched());
}

TEST_F(IncrementalBake, VerifyMeasuresWhatIsUnchangedToo) {
  write_level(5);
  const std::vector<std::string> verify{"--verify", "--verify-points", "50"};
  ASSERT_EQ(bake_level("maps", verify).exit_code, 0);
  const KeptFile left(path("maps/left.pdsm")), manifest(path("maps/manifest.json"));
  ASSERT_EQ(bake_level("maps", verify).exit_code, 0);
  EXPECT_TRUE(left.is_untouched() && manifest.is_untouched());
}

TEST_F(IncrementalBake, DepfileNamesWhatWasRead) {
  write_level(5);
  ASSERT_EQ(bake_level("maps", {"--depfile", "level.d"}).exit_code, 0);
  EXPECT_EQ(contents("level.d"),
            "maps/manifest.json: \\\n  level.scene.json \\\n  plate.obj \\\n  floor.obj\n"
            "level.scene.json:\nplate.obj:\nfloor.obj:\n");
  bake_small("map.pdsm", {"--depfile", "map.d"});
  EXPECT_EQ(contents("map.d").rfind("map.pdsm: \\\n  one.scene.json", 0), 0U) << contents("map.d");
}

TEST_F(IncrementalBake, DepfileEscapesAsMakeAndNinjaExpect) {
  fs::copy_file(path("plate.obj"), path("a b#c$d\\ e:f.obj"));
  write_file("odd.scene.json",
             R"({ "geometry": [ { "file": "a b#c$d\\ e:f.obj" }, { "file": "floor.obj" } ], "lights": [
    { "name": "key", "type": "rect", "position": [0, 4, 0], "direction": [0, -1, 0], "width": 1, "height": 1 } ] })");
  ASSERT_EQ(run({"bake", "odd.scene.json", "-o", "x.pdsm", "--samples", "4", "--resolution", "8", "--depfile",
                 "x.d"})
                .exit_code,
            0);
  EXPECT_NE(contents("x.d").find("\n  a\\ b\\#c$$d\\\\\\ e\\:f.obj \\\n"), std::string::npos)
      << contents("x.d");
}

TEST_F(IncrementalBake, DepfileRefusesWhatMakeAndNinjaReadInTwoWays) {
  const auto bake_plate = [&](const std::string& plate, const std::string& map) {
    fs::copy_file(path("plate.obj"), path(plate), fs::copy_options::overwrite_existing);
    write_file("odd.scene.json", R"({ "geometry": [ { "file": ")" + plate + R"(" } ], "lights": [
      { "name": "key", "type": "rect", "position": [0, 4, 0], "direction": [0, -1, 0], "width": 1, "height": 1, "fov": 40 } ] })");
    return run(
        {"bake", "odd.scene.json", "-o", map, "--samples", "4", "--resolution", "8", "--depfile", "x.d"});
  };
  expect_exit(bake_plate("a;b.obj", "x.pdsm"), 2);
  expect_exit(bake_plate("plain.obj", "100%.pdsm"), 2);
  EXPECT_FALSE(exists("x.d"));
  ASSERT_EQ(bake_plate("50%.obj", "x.pdsm").exit_code, 0);
  EXPECT_EQ(contents("x.d"), "x.pdsm: \\\n  odd.scene.json \\\n  50%.obj\nodd.scene.json:\n");
}

TEST_F(IncrementalBake, DepfileIsNoOtherFile) {
  expect_exit(run({"bake", "one.scene.json", "-o", "x.pdsm", "--depfile", "./x.pdsm"}), 2);
  expect_exit(run({"bake", "one.scene.json", "-o", "x.pdsm", "--depfile", "plate.obj"}), 2);
  expect_exit(run({"bake", "one.scene.json", "-o", "x.pdsm", "--report", "r", "--depfile", "r"}), 2);
  EXPECT_FALSE(exists("x.pdsm"));
}

}  // namespace
}  // namespace pdsm
