// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "pdsm/bake/scene_file.h"

namespace pdsm::test {

/// A folder for the files of one test; removed at the end.
class SceneFolder {
 public:
  SceneFolder();
  ~SceneFolder();
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a file of the folder.
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;

  /// Writes level.scene.json and reads it.
  [[nodiscard]] Scene read(const std::string& scene) const;

  /// What reading `scene` from level.scene.json is refused with, the folder's own path taken out; empty if it
  /// is not. Fails the test unless that is an Error (input) of one line.
  [[nodiscard]] std::string fault_of(const std::string& scene) const;

  /// The same of reading one file as a scene.
  [[nodiscard]] std::string scene_fault_of(const std::string& name) const;

  /// The same of reading one file as geometry.
  [[nodiscard]] std::string import_fault_of(const std::string& name) const;

 private:
  template <typename Read>
  std::string fault(Read&& read) const;

  std::filesystem::path path_;
};

/// A scene with one piece of geometry and no lights.
std::string scene_of(const std::string& file, const std::string& more_fields = "");

/// A scene with one disk light that has every required field, and `fields` ("\"a\": 1, ...") besides. A
/// required field that `fields` names is left to it.
std::string scene_with_light(const std::string& fields);

}  // namespace pdsm::test
