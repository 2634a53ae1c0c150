// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cli/bake_options.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// One map to make.
struct MapJob {
  const Light* light;
  BakeOptions options;
  std::filesystem::path output;
};

/// The maps of one command.
struct MapJobs {
  std::vector<MapJob> maps;
  /// All lights of the scene, into a folder: they get a manifest.
  bool is_level = false;

  [[nodiscard]] std::filesystem::path manifest() const;
};

/// What `command` asks for. Throws as chosen_lights() does. Borrows `scene`.
[[nodiscard]] MapJobs plan_jobs(const BakeCommand& command, const Scene& scene);

/// Checks all outputs before any work is done for them, and makes the folder for several maps where its
/// parent is there. Throws Error (usage, resource).
void prepare_outputs(const BakeCommand& command, const MapJobs& jobs);

}  // namespace pdsm
