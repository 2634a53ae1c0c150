// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <array>
#include <fstream>
#include <utility>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Whether the file's first bytes are those of FORMAT.md section 2, or its name says that it should be a map.
bool is_map(const std::filesystem::path& path) {
  if (path.extension() == ".pdsm") return true;
  std::error_code ignored;
  if (path.extension() == ".json" || !std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, 5> first{};
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  return first == std::array<char, 5>{'\xAB', 'P', 'D', 'S', 'M'};
}

}  // namespace

SortedFiles sort_files(const std::vector<std::filesystem::path>& files) {
  SortedFiles sorted;
  for (const std::filesystem::path& file : files)
    (is_map(file) ? sorted.maps : sorted.scenes).push_back(file);
  return sorted;
}

void Session::open(const std::filesystem::path& scene_file,
                   const std::vector<std::filesystem::path>& map_files) {
  auto stage = std::make_shared<const Stage>(scene_file);
  MapLibrary library;
  for (const std::filesystem::path& file : map_files) library.add(file, stage->scene(), false, messages_);
  replace_stage(std::move(stage), std::move(library));
}

void Session::drop(const std::vector<std::filesystem::path>& files) {
  const SortedFiles sorted = sort_files(files);
  for (const std::filesystem::path& file : sorted.scenes) drop_scene(file);
  for (const std::filesystem::path& file : sorted.maps) drop_map(file);
}

void Session::refresh() {
  if (stage_ && library_.refresh(stage_->scene(), messages_)) ++map_version_;
}

void Session::replace_stage(std::shared_ptr<const Stage> stage, MapLibrary library) {
  for (const std::string& warning : stage->scene().warnings) messages_.note("warning: " + warning);
  stage_ = std::move(stage);
  library_ = std::move(library);
  lights_ = initial_lights(*stage_, library_);
  ++stage_version_;
  ++map_version_;
}

void Session::drop_scene(const std::filesystem::path& scene_file) {
  try {
    auto stage = std::make_shared<const Stage>(scene_file);
    MapLibrary library;
    for (const std::filesystem::path& file : std::exchange(waiting_, {})) {
      try {
        library.add(file, stage->scene(), true, messages_);
      } catch (const Error& error) {
        messages_.fault(error.what());
      }
    }
    for (const LoadedMap& map : library_.maps()) {
      try {
        library.add(map.path, stage->scene(), true, messages_);
      } catch (const Error& error) {
        messages_.note(std::string(error.what()) + "; left out");  // no wonder: it is of the old scene
      }
    }
    replace_stage(std::move(stage), std::move(library));
  } catch (const Error& error) {
    messages_.fault(error.what());
  }
}

void Session::drop_map(const std::filesystem::path& map_file) {
  if (!stage_) {
    waiting_.push_back(map_file);
    messages_.note(map_file.string() + ": waits for its scene");
    return;
  }
  try {
    const bool first = library_.maps().empty();
    library_.add(map_file, stage_->scene(), true, messages_);
    if (first) {
      lights_ = initial_lights(*stage_, library_);
    } else {
      for (const LoadedMap& map : library_.maps()) {
        if (map.path == map_file) lights_[map.light].on = true;
      }
    }
    ++map_version_;
  } catch (const Error& error) {
    messages_.fault(error.what());
  }
}

}  // namespace pdsm
