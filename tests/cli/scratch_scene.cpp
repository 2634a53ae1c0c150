// SPDX-License-Identifier: Apache-2.0
#include "scratch_scene.h"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace pdsm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlate = "v -1 1 -1\nv -1 1 1\nv 1 1 1\nv 1 1 -1\nf 1 2 3\nf 1 3 4\n";
constexpr const char* kFloor = "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3\nf 1 3 4\n";
constexpr const char* kKey =
    R"({ "name": "key", "type": "rect", "position": [0, 4, 0], "direction": [0, -1, 0], "width": 1, "height": 1 })";
constexpr const char* kLamp =
    R"({ "name": "lamp", "type": "disk", "position": [2, 4, 1], "direction": [-1, -3, 0], "radius": 0.3 })";

std::string scene_text(const std::string& lights) {
  return R"({ "geometry": [ { "file": "plate.obj" }, { "file": "floor.obj" } ], "lights": [ )" + lights +
         " ] }";
}

}  // namespace

ScratchScene::ScratchScene() {
  std::string name = (fs::temp_directory_path() / "pdsm_cli_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
  folder_ = name;
  fs::permissions(folder_, fs::perms::all);
  write_file("plate.obj", kPlate);
  write_file("floor.obj", kFloor);
  write_file("one.scene.json", scene_text(kKey));
  write_file("two.scene.json", scene_text(std::string(kKey) + ", " + kLamp));
}

ScratchScene::~ScratchScene() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Outcome ScratchScene::run(const std::vector<std::string>& arguments, RunSetup setup) const {
  setup.folder = folder_;
  return run_pdsm(arguments, setup);
}

double ScratchScene::value(const std::vector<std::string>& arguments, const std::string& point) const {
  RunSetup setup;
  setup.input = point + "\n";
  const Outcome outcome = run(arguments, setup);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return std::stod(outcome.out);
}

void ScratchScene::bake_small(const std::string& output, std::vector<std::string> extra) const {
  std::vector<std::string> arguments{"bake", "one.scene.json", "-o", output, "--quiet", "--samples",
                                     "16",   "--resolution",   "32"};
  arguments.insert(arguments.end(), extra.begin(), extra.end());
  const Outcome outcome = run(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

std::string ScratchScene::contents(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void ScratchScene::write_file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::vector<std::string> ScratchScene::listing() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void expect_exit(const Outcome& outcome, int code) {
  EXPECT_EQ(outcome.exit_code, code) << outcome.err;
  if (code <= 1) return;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\n")) << outcome.err;
}

}  // namespace pdsm
