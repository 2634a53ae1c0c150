// SPDX-License-Identifier: Apache-2.0
#include "plate_scene.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "cli/bake_record.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/map_file.h"
#include "picture.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

constexpr double kLightHeight = 4, kPlateHeight = 1, kPlateLow = 0.95, kLightHalf = 0.5, kPlateHalf = 1,
                 kFloorHalf = 9;
/// 5 cm thick: its shadow is that of its upper face.
constexpr const char* kPlate =
    "v -1 1 -1\nv -1 1 1\nv 1 1 1\nv 1 1 -1\nv -1 0.95 -1\nv -1 0.95 1\nv 1 0.95 1\nv 1 0.95 -1\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
constexpr const char* kFloor = "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3\nf 1 3 4\n";
constexpr const char* kKey =
    R"({ "name": "key", "type": "rect", "position": [0, 4, 0], "direction": [0, -1, 0], "width": 1, "height": 1 })";
constexpr const char* kLamp =
    R"({ "name": "lamp", "type": "disk", "position": [2, 4, 1], "direction": [-1, -3, 0], "radius": 0.3 })";

fs::path scratch_folder;

std::string scene_text(const std::string& geometry, const std::string& lights) {
  return R"({ "geometry": [ )" + geometry + R"( ], "lights": [ )" + lights + " ] }";
}

/// Bakes a light of a scene into NAME.
void bake_light(const std::string& scene_file, std::size_t light, const std::string& name) {
  const Scene scene = read_scene(scratch_folder / scene_file);
  BakeOptions options;
  options.samples = 128;
  options.width = options.height = 192;
  BakedMap baked = bake(scene, scene.lights[light], options);
  baked.map.metadata = bake_metadata(scene.lights[light], options, baked);
  write_encoded_map(baked.map, baked.blocks, scratch_folder / name);
}

}  // namespace

void PlateScene::SetUpTestSuite() {
  std::string name = (fs::temp_directory_path() / "pdsm_viewer_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
  scratch_folder = name;
  const std::string plate = R"({ "file": "plate.obj" })", floor = R"({ "file": "floor.obj" })";
  write("plate.obj", kPlate);
  write("floor.obj", kFloor);
  write("plate.scene.json", scene_text(plate + ", " + floor, kKey));
  write("bare.scene.json", scene_text(floor, kKey));
  write("two.scene.json", scene_text(plate + ", " + floor, std::string(kKey) + ", " + kLamp));
  write("lamp.scene.json", scene_text(plate + ", " + floor, kLamp));
  bake_light("plate.scene.json", 0, "baked.pdsm");
  bake_light("bare.scene.json", 0, "empty.pdsm");
  bake_light("two.scene.json", 1, "lamp.pdsm");
}

void PlateScene::TearDownTestSuite() {
  std::error_code ignored;
  fs::remove_all(scratch_folder, ignored);
}

void PlateScene::SetUp() {
  copy("baked.pdsm", "key.pdsm");
  fs::remove(path("shot.png"));
}

const fs::path& PlateScene::folder() {
  return scratch_folder;
}

ViewerOutcome PlateScene::run(const std::vector<std::string>& arguments, bool display) {
  return ViewerProcess(arguments, scratch_folder, display).finish();
}

RgbImage PlateScene::picture(std::vector<std::string> arguments, ViewerOutcome* outcome) {
  const auto add_unless_there = [&arguments](const std::string& option, const std::string& value) {
    if (std::find(arguments.begin(), arguments.end(), option) != arguments.end()) return;
    arguments.insert(arguments.end(), {option, value});
  };
  add_unless_there("--show", "none");
  add_unless_there("--camera", "1.5,3.2,6,0.4,0.2,0,45");
  arguments.insert(arguments.end(), {"--size", "320x240", "--screenshot", "shot.png", "--no-ui"});
  const bool own_scene = std::any_of(arguments.begin(), arguments.end(),
                                     [](const std::string& a) { return a.ends_with(".json"); });
  if (!own_scene) arguments.insert(arguments.end(), {"plate.scene.json", "key.pdsm"});
  const ViewerOutcome ran = run(arguments);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  RgbImage image = read_png(path("shot.png"));
  EXPECT_EQ(image.width, kWidth);
  EXPECT_EQ(image.height, kHeight);
  if (outcome != nullptr) *outcome = ran;
  return image;
}

void PlateScene::copy(const std::string& from, const std::string& to) {
  // Renamed into place, as every writer of maps does.
  fs::copy_file(path(from), path(to + ".part"), fs::copy_options::overwrite_existing);
  fs::rename(path(to + ".part"), path(to));
}

void PlateScene::write(const std::string& name, const std::string& text) {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::optional<glm::dvec3> PlateScene::floor_at(double x, double y) {
  const glm::dvec3 eye = camera().eye, direction = CameraRays(camera(), kWidth, kHeight).direction(x, y);
  if (!(direction.y < 0)) return std::nullopt;
  const auto at_height = [&](double height) { return eye + (height - eye.y) / direction.y * direction; };
  const glm::dvec3 floor = at_height(0);
  for (const glm::dvec3& plate : {at_height(kPlateHeight), at_height(kPlateLow)}) {
    if (std::max(std::abs(plate.x), std::abs(plate.z)) <= kPlateHalf) return std::nullopt;
  }
  if (std::max(std::abs(floor.x), std::abs(floor.z)) > kFloorHalf) return std::nullopt;
  return floor;
}

double PlateScene::hidden_from(const glm::dvec3& floor_point) {
  // A light point s is hidden when the plate holds where the ray passes it: |x + (s - x) h| <= p, h its share
  // of the way up. Plate and light are squares along the axes: the share is a product.
  constexpr double h = kPlateHeight / kLightHeight;
  const auto share = [](double x) {
    const double low = (-kPlateHalf - (1 - h) * x) / h, high = (kPlateHalf - (1 - h) * x) / h;
    const double length = std::min(high, kLightHalf) - std::max(low, -kLightHalf);
    return std::clamp(length / (2 * kLightHalf), 0.0, 1.0);
  };
  return share(floor_point.x) * share(floor_point.z);
}

void expect_fault(const ViewerOutcome& outcome, int code) {
  EXPECT_EQ(outcome.exit_code, code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\n")) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace pdsm
