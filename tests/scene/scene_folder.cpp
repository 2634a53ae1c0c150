// SPDX-License-Identifier: Apache-2.0
#include "scene_folder.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <stdexcept>

#include "pdsm/format/error.h"

namespace pdsm::test {

namespace fs = std::filesystem;

SceneFolder::SceneFolder() {
  std::string name = (fs::temp_directory_path() / "pdsm_scene_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for the test's files");
  path_ = name;
}

SceneFolder::~SceneFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path SceneFolder::write(const std::string& name, const std::string& bytes) const {
  const fs::path file = path_ / name;
  // Some file systems flush a file that is overwritten, which would make the tests slow.
  fs::remove(file);
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

Scene SceneFolder::read(const std::string& scene) const {
  return read_scene(write("level.scene.json", scene));
}

template <typename Read>
std::string SceneFolder::fault(Read&& read) const {
  try {
    read();
  } catch (const Error& error) {
    std::string text = error.what();
    EXPECT_EQ(error.failure(), Failure::input) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    const std::string prefix = path_.string() + "/";
    for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
      text.erase(at, prefix.size());
    return text;
  }
  return "";
}

std::string SceneFolder::fault_of(const std::string& scene) const {
  return fault([&] { (void)read(scene); });
}

std::string SceneFolder::scene_fault_of(const std::string& name) const {
  return fault([&] { (void)read_scene(path_ / name); });
}

std::string SceneFolder::import_fault_of(const std::string& name) const {
  return fault([&] { (void)import_geometry(path_ / name); });
}

std::string scene_of(const std::string& file, const std::string& more_fields) {
  return R"({"geometry": [{"file": ")" + file + "\"" + (more_fields.empty() ? "" : ", " + more_fields) +
         "}]}";
}

std::string scene_with_light(const std::string& fields) {
  std::string light = fields;
  const auto add = [&](const std::string& key, const std::string& value) {
    if (light.find("\"" + key + "\"") == std::string::npos)
      light += (light.empty() ? "" : ", ") + ("\"" + key + "\": " + value);
  };
  add("type", "\"disk\"");
  add("position", "[0, 5, 0]");
  add("direction", "[0, -1, 0]");
  if (light.find("\"disk\"") != std::string::npos) add("radius", "0.5");
  return R"({"lights": [{)" + light + "}]}";
}

}  // namespace pdsm::test
