// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "light_set.h"
#include "map_library.h"
#include "messages.h"
#include "stage.h"

namespace pdsm {

/// Files named by a person, told apart: maps by their first bytes or .pdsm, anything else is a scene.
struct SortedFiles {
  std::vector<std::filesystem::path> scenes, maps;
};
[[nodiscard]] SortedFiles sort_files(const std::vector<std::filesystem::path>& files);

/// What is being looked at: a scene, its maps, its lights. Knows no window.
class Session {
 public:
  /// Reads a scene and its maps in place of what was there. Throws Error (input, usage, resource) and leaves
  /// what was there.
  void open(const std::filesystem::path& scene_file, const std::vector<std::filesystem::path>& map_files);

  /// Takes files as they are dropped: a scene replaces the old one, whose maps stay as far as they fit; maps
  /// join or replace those of the same light. Faults are messages.
  void drop(const std::vector<std::filesystem::path>& files);

  /// Reads maps anew whose files have changed.
  void refresh();

  /// Null before any scene.
  [[nodiscard]] const std::shared_ptr<const Stage>& stage() const { return stage_; }
  [[nodiscard]] const MapLibrary& library() const { return library_; }
  [[nodiscard]] std::vector<LightControl>& lights() { return lights_; }
  [[nodiscard]] const std::vector<LightControl>& lights() const { return lights_; }
  [[nodiscard]] Messages& messages() { return messages_; }

  /// Rise whenever the scene, or any map, is another one.
  [[nodiscard]] std::uint64_t stage_version() const { return stage_version_; }
  [[nodiscard]] std::uint64_t map_version() const { return map_version_; }

 private:
  void replace_stage(std::shared_ptr<const Stage> stage, MapLibrary library);
  void drop_scene(const std::filesystem::path& scene_file);
  void drop_map(const std::filesystem::path& map_file);

  Messages messages_;
  std::shared_ptr<const Stage> stage_;
  MapLibrary library_;
  std::vector<LightControl> lights_;
  std::vector<std::filesystem::path> waiting_;  ///< maps that came before any scene
  std::uint64_t stage_version_ = 0, map_version_ = 0;
};

}  // namespace pdsm
