// SPDX-License-Identifier: Apache-2.0
#include "cli/level_bake.h"

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/stop_watch.h"
#include "cli/streams.h"
#include "pdsm/bake/manifest.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// The last object of a light.
void tell_end(const BakeCommand& command, const LightOutcome& outcome) {
  if (progress_style(command) != ProgressStyle::json) return;
  ProgressLine({outcome.job->light->name, ""}, ProgressStyle::json).show({status_name(outcome.status), 1, 0});
}

/// What a light's failure leaves behind when the others go on. Only what is this light's own is kept; a
/// failure of options or an interrupt is everyone's.
LightOutcome failed(const MapJob& job, const std::string& reason, int exit_code) {
  LightOutcome outcome;
  outcome.job = &job;
  outcome.status = LightOutcome::Status::failed;
  // The manifest tells no path but the maps'.
  const std::string path = job.output.string() + ": ";
  outcome.reason = reason.rfind(path, 0) == 0 ? reason.substr(path.size()) : reason;
  outcome.exit_code = exit_code;
  outcome.report = {{"status", status_name(outcome.status)}, {"reason", reason}};
  write_error_line(job.light->name + ": " + reason);
  return outcome;
}

LightOutcome bake_one_of_level(const LightBakeInput& input, const MapJob& job,
                               std::optional<double> time_share) {
  try {
    return bake_light(input, job, time_share);
  } catch (const GoalMissed& missed) {
    return failed(job, missed.what(), kExitDoesNotHold);
  } catch (const Error& error) {
    if (error.failure() != Failure::input && error.failure() != Failure::resource) throw;
    return failed(job, error.what(), static_cast<int>(error.failure()));
  }
}

ManifestLight manifest_light(const LightOutcome& outcome) {
  ManifestLight entry;
  entry.light = *outcome.job->light;
  entry.reason = outcome.reason;
  if (outcome.status == LightOutcome::Status::skipped) entry.status = MapStatus::skipped;
  if (outcome.status == LightOutcome::Status::failed) entry.status = MapStatus::failed;
  entry.file = outcome.job->output.filename().string();
  entry.bytes = outcome.bytes;
  entry.key = outcome.key;
  entry.view = outcome.view;
  if (outcome.error) {
    entry.error = {outcome.error->mean_abs_error, outcome.error->p99_error, outcome.error->max_error,
                   outcome.error->points, outcome.error->shadowed_points};
  }
  return entry;
}

}  // namespace

std::vector<LightOutcome> bake_lights(const LightBakeInput& input, const MapJobs& jobs) {
  const StopWatch watch;
  const std::optional<double>& budget = input.command.goals.time_budget;
  std::vector<LightOutcome> outcomes;
  for (const MapJob& job : jobs.maps) {
    std::optional<double> share;
    if (budget) share = (*budget - watch.seconds()) / static_cast<double>(jobs.maps.size() - outcomes.size());
    outcomes.push_back(input.is_level ? bake_one_of_level(input, job, share) : bake_light(input, job, share));
    tell_end(input.command, outcomes.back());
  }
  if (budget && watch.seconds() > *budget) {
    write_warning(fmt::format("--time-budget: took {:.1f} s", watch.seconds()));
  }
  return outcomes;
}

void write_level_manifest(const std::vector<LightOutcome>& outcomes, const std::filesystem::path& path) {
  std::vector<ManifestLight> lights;
  for (const LightOutcome& outcome : outcomes) lights.push_back(manifest_light(outcome));
  write_manifest(lights, path);
}

}  // namespace pdsm
