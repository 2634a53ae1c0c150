// SPDX-License-Identifier: Apache-2.0
#include "small_sweep.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "plates.h"

namespace pdsm {

namespace fs = std::filesystem;

SweepFolder::SweepFolder() {
  std::string name = (fs::temp_directory_path() / "pdsm_sweep_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
  folder_ = name;
}

SweepFolder::~SweepFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string SweepFolder::contents(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void SweepFolder::write_file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

SweepOptions SweepFolder::small_options() const {
  SweepOptions options;
  options.folder = path();
  options.effort = Effort::quick;
  options.options.samples = 16;
  options.options.width = options.options.height = 32;
  options.verify.points = 200;
  options.verify.samples = 64;
  return options;
}

Scene small_scene() {
  Scene scene;
  scene.lights = {light_at_origin(RectLight{1, 1})};
  scene.geometry = {plate(-0.5, -0.5, 0.5, 0.5, 4), quad({-4, -4, 7}, {4, -4, 7}, {4, 4, 9}, {-4, 4, 9})};
  scene.content_hash = 1;
  return scene;
}

SweepCallbacks plain_callbacks() {
  SweepCallbacks callbacks;
  callbacks.metadata = [](const Light&, const BakeOptions&, const BakedMap&) { return std::string("{}"); };
  return callbacks;
}

Measurement example_measurement(std::uint32_t samples) {
  Measurement m;
  m.setting = {samples, 30, 20, 0.5, Walk::midpoint, 0.1 + 0.2, 1.5};
  m.seconds = 1.0 / 3;
  m.cpu_seconds = 2.0 / 3;
  m.rays = 1;
  m.events = 2;
  m.pieces = 3;
  m.file_bytes = std::uint64_t{1} << 60;
  m.gpu_bytes = 5;
  m.error = {6, 7, 21, 8, 9, 0.11, 0.12, 0.13, 0.14, 0.15, 0.16, -0.17, 0.18};
  m.tube = {19, 20, -1e-17};
  return m;
}

}  // namespace pdsm
