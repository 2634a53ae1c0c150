// SPDX-License-Identifier: Apache-2.0
#include "cli/map_jobs.h"

#include <system_error>

#include "cli/inputs.h"
#include "pdsm/bake/manifest.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

/// Makes the folder for several maps, in a folder that is there.
void make_output_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (fs::exists(folder, error)) {
    throw Error(Failure::usage, "--output", "must be a folder, as the scene has several lights");
  }
  if (!fs::create_directory(folder, error)) throw Error(Failure::resource, folder.string(), error.message());
}

/// A file to be written, and the option that names it.
struct Output {
  const char* option;
  fs::path path;
};

void check_distinct(const std::vector<Output>& outputs) {
  for (std::size_t n = 1; n < outputs.size(); ++n) {
    // Maps have names of their own.
    if (outputs[n].option == std::string("--output")) continue;
    for (std::size_t other = 0; other < n; ++other) {
      if (same_path(outputs[n].path, outputs[other].path))
        throw Error(Failure::usage, outputs[n].option, "is another output of the bake too");
    }
  }
}

}  // namespace

fs::path MapJobs::manifest() const {
  return maps.front().output.parent_path() / kManifestName;
}

MapJobs plan_jobs(const BakeCommand& command, const Scene& scene) {
  const std::vector<const Light*> lights = chosen_lights(scene, command.light);
  std::error_code ignored;
  const bool in_folder = lights.size() > 1 || fs::is_directory(command.output, ignored);
  MapJobs jobs;
  for (const Light* light : lights) {
    fs::path output = command.output;
    if (in_folder) output /= light->name + ".pdsm";
    jobs.maps.push_back({light, options_for(command, *light), output});
  }
  jobs.is_level = in_folder && !command.light;
  return jobs;
}

void prepare_outputs(const BakeCommand& command, const MapJobs& jobs) {
  if (jobs.maps.size() > 1) make_output_folder(command.output);
  const std::vector<fs::path> inputs = scene_inputs(command.scene);
  std::vector<Output> outputs;
  for (const MapJob& job : jobs.maps) outputs.push_back({"--output", job.output});
  if (jobs.is_level) outputs.push_back({"--output", jobs.manifest()});
  if (!command.report.empty()) outputs.push_back({"--report", command.report});
  if (!command.depfile.empty()) outputs.push_back({"--depfile", command.depfile});
  for (const Output& output : outputs) check_output(output.path, inputs);
  check_distinct(outputs);
}

}  // namespace pdsm
