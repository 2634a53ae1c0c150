// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/bake_options.h"
#include "cli/bake_record.h"
#include "cli/bake_summary.h"
#include "cli/command.h"
#include "cli/depfile.h"
#include "cli/level_bake.h"
#include "cli/map_jobs.h"
#include "cli/progress_line.h"
#include "cli/shard_bake.h"
#include "cli/stop_watch.h"
#include "cli/streams.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

void write_depfile(const BakeCommand& command, const Scene& scene, const MapJobs& jobs) {
  if (command.depfile.empty()) return;
  const fs::path target = jobs.is_level ? jobs.manifest() : jobs.maps.front().output;
  const std::string text = depfile_text(target, scene.files);
  AtomicFile file(command.depfile);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

void print_prediction(const Scene& scene, const MapJob& job) {
  const BakePrediction prediction = predict_bake(scene, *job.light, job.options);
  const FittedView fitted = fit_view(scene, *job.light, job.options.width, job.options.height);
  const auto& window = fitted.view.window;
  write_result(fmt::format(
      "{}\n"
      "  rays               {}\n"
      "  events             {}\n"
      "  time               about {}\n"
      "  memory             {:.0f} MB, {:.0f} MB of them scene and BVH\n"
      "  tiles              {} of {} x {} texels\n"
      "  window             [{:.6g}, {:.6g}, {:.6g}, {:.6g}]{}\n"
      "  near, far          {:.6g}, {:.6g} m\n"
      "  receivers outside  {:.2f}%\n",
      job.light->name, prediction.rays, prediction.events, minutes_text(prediction.seconds),
      1e-6 * static_cast<double>(prediction.scene_bytes + prediction.memory_bytes),
      1e-6 * static_cast<double>(prediction.scene_bytes), prediction.tiles, prediction.tile, prediction.tile,
      window[0], window[1], window[2], window[3], fitted.window_fitted ? ", fitted" : "",
      fitted.view.near_depth, fitted.view.far_depth, 100 * fitted.receivers_outside));
}

void write_reports(const BakeCommand& command, const std::vector<LightOutcome>& outcomes) {
  if (command.report.empty()) return;
  nlohmann::ordered_json reports;
  for (const LightOutcome& outcome : outcomes) reports[outcome.job->light->name] = outcome.report;
  write_report(command.report, outcomes.size() == 1 ? reports.front() : reports);
}

/// The errors of single maps, which have no table.
void tell_error(const LightOutcome& outcome) {
  if (!outcome.error) return;
  write_error_line(fmt::format("{}: mean abs error {:.5f} at {} points", outcome.job->light->name,
                               outcome.error->mean_abs_error, outcome.error->points));
}

void tell_outcomes(const std::vector<LightOutcome>& outcomes, bool is_level, double seconds) {
  if (is_level) {
    for (const std::string& line : summary_lines(outcomes, seconds)) write_error_line(line);
  } else {
    std::ranges::for_each(outcomes, tell_error);
  }
}

/// The first failure's, else whether all errors are as small as they were asked to be.
int exit_code(const BakeCommand& command, const std::vector<LightOutcome>& outcomes) {
  for (const LightOutcome& outcome : outcomes) {
    if (outcome.exit_code != kExitOk) return outcome.exit_code;
  }
  const bool holds = std::ranges::all_of(outcomes, [&](const LightOutcome& outcome) {
    return !command.max_error || !outcome.error || outcome.error->mean_abs_error <= *command.max_error;
  });
  return holds ? kExitOk : kExitDoesNotHold;
}

int bake_jobs(const LightBakeInput& input, const MapJobs& jobs, const StopWatch& watch) {
  prepare_outputs(input.command, jobs);
  const std::vector<LightOutcome> outcomes = bake_lights(input, jobs);
  write_reports(input.command, outcomes);
  if (jobs.is_level) write_level_manifest(outcomes, jobs.manifest());
  if (!input.command.quiet) tell_outcomes(outcomes, jobs.is_level, watch.seconds());
  const int code = exit_code(input.command, outcomes);
  // What failed has to be tried again, whatever changes.
  if (code == kExitOk || code == kExitDoesNotHold) write_depfile(input.command, input.scene, jobs);
  return code;
}

int run_bake(const BakeCommand& command) {
  if (command.output.empty() && !command.dry_run) {
    throw Error(Failure::usage, "--output", "is required, except for --dry-run");
  }
  check_goals(command);
  if (command.shard) check_shard(command);
  const StopWatch watch;
  const Scene scene = read_scene(command.scene);
  const double seconds_load = watch.seconds();
  tell_warnings(command, "", scene.warnings);
  if (command.shard) {
    run_shard_bake(command, scene);
    return kExitOk;
  }
  const MapJobs jobs = plan_jobs(command, scene);
  if (command.dry_run) {
    for (const MapJob& job : jobs.maps) print_prediction(scene, job);
    return kExitOk;
  }
  try {
    return bake_jobs({command, scene, jobs.is_level, seconds_load}, jobs, watch);
  } catch (const GoalMissed& missed) {
    write_error_line(missed.what());
    return kExitDoesNotHold;
  }
}

}  // namespace

void add_bake_command(CommandLine& line) {
  auto command = std::make_shared<BakeCommand>();
  Options takes =
      line.add_command("bake", "Bake the maps of a scene's lights", [command] { return run_bake(*command); });
  add_bake_options(takes, *command);
}

}  // namespace pdsm
